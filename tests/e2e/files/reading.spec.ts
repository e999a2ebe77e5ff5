import { truncatedBvh } from '../support/files';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

test.use({ viewport: { width: 1280, height: 720 } });

test('a truncated leader file is read up to its last complete frame, without its rest pose, and the page says so', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(truncatedBvh());
  await app.until(({ leader }) => leader?.name === 'truncated.bvh');
  await expect(app.alert).toBeHidden();
  expect(await app.read(({ leader }) => leader?.file.clip.frames)).toBe(39);
  const notes = page.getByRole('list', { name: 'Notes' });
  await expect(notes).toContainText(
    'The file ends in the middle of frame 41 of 60; the 40 whole frames are used.',
  );
  await expect(notes).toContainText('The first frame is a rest pose and is left out.');
});
