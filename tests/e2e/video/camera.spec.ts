/** Recording a leader with the webcam. */
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

// A camera that shows a test picture without any person.
test.use({
  launchOptions: async ({ launchOptions }, use) => {
    await use({
      ...launchOptions,
      args: [...(launchOptions.args ?? []), '--use-fake-device-for-media-stream'],
    });
  },
});

test('a recording counts down, plays the song, and is read', async ({ page, context }) => {
  await context.grantPermissions(['camera']);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const before = await app.read(({ leader }) => leader?.name);
  const opener = page.getByRole('button', { name: 'Use the camera' });
  await opener.click();
  const dialog = page.getByRole('dialog', { name: 'Record with the camera' });
  const picture = dialog.getByLabel('Picture of the camera');
  await expect.poll(() => picture.evaluate((video: HTMLVideoElement) => video.videoWidth)).toBeGreaterThan(0);
  // Escape closes what is in front.
  const keys = page.getByRole('dialog', { name: 'Keyboard shortcuts' });
  await page.keyboard.press('?');
  await expect(keys).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(keys).toBeHidden();
  await expect(dialog).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(dialog).toBeHidden();
  await expect(opener).toBeFocused();
  await page.getByRole('combobox', { name: 'Speed' }).selectOption('0.5');
  await opener.click();
  await dialog.getByRole('button', { name: 'Record' }).click();
  const spoken = dialog.getByRole('status');
  await expect(dialog.getByText('3', { exact: true })).toBeVisible();
  await expect(spoken).toHaveText('The recording starts in 5 seconds.');
  await expect(dialog.getByText('Recording, 1 of at most 120 s')).toBeVisible();
  // A clock that is spoken every second would be heard over everything else.
  await expect(spoken).toHaveText('Recording.');
  expect(
    await app.read(({ playback, song }) => song !== null && playback.playing && playback.speed),
    'the song has its own speed',
  ).toBe(1);
  await dialog.getByRole('button', { name: 'Stop' }).click();
  await expect(dialog).toBeHidden();
  await expect(page.getByRole('status').getByText('The recording has ended.')).toBeAttached();
  // Nobody is in the picture.
  await expect(app.alert).toHaveAttribute('data-code', 'no-person', { timeout: 60_000 });
  const after = await app.read(({ leader, playback }) => [leader?.name, playback.playing, playback.speed]);
  expect(after).toEqual([before, false, 0.5]);
});

test('a camera that stops by itself ends the recording, and what was recorded is read', async ({
  page,
  context,
}) => {
  await context.grantPermissions(['camera']);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const dialog = page.getByRole('dialog', { name: 'Record with the camera' });
  const unplug = (): Promise<void> =>
    dialog.getByLabel('Picture of the camera').evaluate((video: HTMLVideoElement) => {
      for (const track of (video.srcObject as MediaStream).getTracks()) track.stop();
    });
  await page.getByRole('button', { name: 'Use the camera' }).click();
  await dialog.getByRole('button', { name: 'Record' }).click();
  await expect(dialog.getByText('Recording, 2 of at most 120 s')).toBeVisible();
  await unplug();
  await expect(dialog).toBeHidden();
  await expect(page.getByRole('status').getByText('The camera has stopped')).toBeAttached();
  await expect(app.alert).toHaveAttribute('data-code', 'no-person', { timeout: 60_000 });
  expect(await app.read(({ playback }) => playback.playing)).toBe(false);

  await test.step('and before the recording it is a sentence', async () => {
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Project' }).click();
    await page.getByRole('button', { name: /^Record a leader/ }).click();
    await dialog.getByRole('button', { name: 'Record' }).click();
    await expect(dialog.getByText('3', { exact: true })).toBeVisible();
    await unplug();
    await expect(app.alert).toHaveAttribute('data-code', 'camera-stopped');
    await expect(dialog).toBeHidden();
  });
});

test('a camera that is refused is a sentence', async ({ page, context }) => {
  await context.clearPermissions();
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  // There too where the first visit is over.
  await page.getByRole('button', { name: 'Project' }).click();
  await page.getByRole('button', { name: /^Record a leader/ }).click();
  await expect(app.alert).toHaveAttribute('data-code', 'camera-refused');
  await expect(app.alert).toContainText(/drop the video here/);
  await page.keyboard.press('Escape');
  expect(await app.read(({ leader }) => leader !== null)).toBe(true);
});
