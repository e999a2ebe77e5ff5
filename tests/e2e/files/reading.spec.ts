import { strToU8, type Zippable, zipSync } from 'fflate';
import { madeBody, madeBvh, MIXAMO } from '../../web/support/made-bvh';
import { bvhText, truncatedBvh } from '../support/files';
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

for (const [width, height] of [
  [1280, 720],
  [390, 844],
] as const)
  test(`a leader of a wrong frame rate is read again at half of it on one click, ${width} pixels wide`, async ({
    page,
  }) => {
    await page.setViewportSize({ width, height });
    const app = new App(page);
    await app.openWithoutPicture();
    const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 400, swing: 25 });
    const hurried = text.replace(/(?<=Frame Time: ).*/, '0.0083333');
    await app.drop({ name: 'hurried.bvh', mimeType: '', buffer: Buffer.from(hurried) });
    const button = page.getByRole('button', { name: 'Leader too fast? Read it at 60 fps' });
    await expect(button).toBeInViewport({ ratio: 1 });
    // The whole text is seen.
    expect(await button.evaluate((one) => one.scrollWidth - one.clientWidth)).toBe(0);
    await button.click();
    await app.until(({ leader }) => leader?.file.report.sourceFps === 60);
    await expect(page.getByRole('button', { name: /^Leader too fast/ })).toBeHidden();
  });

test('a zip archive is unpacked: one motion is read, of several one is chosen, and what is wrong with it is said', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  const zip = (name: string, files: Zippable) => ({
    name,
    mimeType: 'application/zip',
    buffer: Buffer.from(zipSync(files)),
  });
  const frames = (count: number): Uint8Array => strToU8(bvhText({ frames: count }));
  await app.chooseLeader(zip('one.zip', { 'takes/salsa.bvh': frames(90) }));
  await app.until(({ leader }) => leader?.name === 'salsa.bvh');
  await app.drop(zip('both-bvh.zip', { 'leader.bvh': frames(60), 'reactor.bvh': frames(75) }));
  const dialog = page.getByRole('dialog', { name: 'Which of these do you want to use?' });
  await dialog.getByRole('radio', { name: 'reactor.bvh' }).check();
  await dialog.getByRole('button', { name: 'Use the leader' }).click();
  await app.until(({ leader }) => leader?.name === 'reactor.bvh' && leader.file.clip.frames === 75);
  await app.drop({ ...zip('cut.zip', {}), buffer: Buffer.from('PK\u0003\u0004 and no more') });
  await expect(app.alert).toContainText('cut.zip cannot be unpacked');
  expect(await app.read(({ leader }) => leader?.name)).toBe('reactor.bvh');
});
