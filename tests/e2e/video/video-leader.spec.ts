import type { Page } from '@playwright/test';
import { App, maxDistance } from '../support/app-page';
import { bvh } from '../support/files';
import { expect, test } from '../support/fixtures';
import { openStudio, SHOT } from '../support/video-files';
import { openWritten } from '../support/written-video';

// A small stage, for a software renderer.
test.use({ viewport: { width: 1000, height: 560 }, colorScheme: 'dark' });

/** Mean brightness of the left and the right half of a video's middle picture, 0 to 255. */
async function halvesOf(page: Page, file: string): Promise<[number, number]> {
  const written = await openWritten(page, file);
  return written.evaluate(({ video }) => {
    const context = new OffscreenCanvas(2, 1).getContext('2d')!;
    context.imageSmoothingQuality = 'high';
    context.drawImage(video, 0, 0, 2, 1);
    const { data } = context.getImageData(0, 0, 2, 1);
    const mean = (i: number): number => (data[i]! + data[i + 1]! + data[i + 2]!) / 3;
    return [mean(0), mean(4)];
  });
}

test('a video becomes the leader, gets a partner, and is shown beside it in the exported video', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const format = { container: 'webm', sound: true } as const;
  const video = Buffer.from(await studio.call('film', 'salsa', SHOT, 5, format), 'base64');
  await studio.close();
  const app = new App(page);
  await app.open();
  await app.settled();
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  const drop = () => app.drop({ name: 'dance.webm', mimeType: 'video/webm', buffer: video });
  const onStage = () =>
    page.evaluate<number[][]>(
      "['leader', 'reactor'].map((role) => Array.from(window.reactdance.stage.jointPositions(role)))",
    );

  // The first seconds are on the stage while the rest is read; when that is cancelled the dance before is there again.
  const before = await onStage();
  await drop();
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await app.until(({ partRead }) => partRead);
  const [alone, nobody] = await onStage();
  expect(maxDistance(alone!, before[0]!)).toBeGreaterThan(0.05);
  expect(Math.max(...nobody!.map(Math.abs))).toBe(0);
  await panel.getByRole('button', { name: 'Cancel' }).click();
  await expect(panel).toBeHidden();
  expect(await app.read(({ leader, partRead }) => [leader?.name, partRead])).toEqual([
    'Made demo leader',
    null,
  ]);
  await expect.poll(onStage).toEqual(before);

  await drop();
  await panel.getByRole('button', { name: 'Cancel' }).focus();
  await app.reaction('dance.webm');
  const close = panel.getByRole('button', { name: 'Close' });
  await expect(close, 'Cancel is gone').toBeFocused();
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/);
  const lane = page.getByRole('img', { name: /The video dance.webm; confidence over 4\.\d s of dance/ });
  await expect(lane).toBeVisible();
  // The camera has the couple in the middle of what the panel leaves free.
  const free = await panel.evaluate(
    ({ offsetLeft, offsetWidth, offsetParent: stage }: HTMLElement) =>
      (stage!.clientWidth - offsetLeft - offsetWidth) / stage!.clientHeight,
  );
  const aspect = (): Promise<number> => page.evaluate('window.reactdance.stage.framing().aspect');
  await expect.poll(aspect).toBeCloseTo(free, 1);
  // Closed it leaves the whole stage to the dancers, and the video is still there.
  await close.press('Enter');
  await expect(panel).toBeHidden();
  await expect.poll(aspect).toBeGreaterThan(1.1 * free);
  const reopen = page.getByRole('button', { name: 'Show the video' });
  await expect(reopen).toBeFocused();
  await expect(lane).toBeVisible();
  // With the mouse: what is focused by keys is pressed by Space, which is to play below.
  await reopen.click();
  await expect(panel).toBeVisible();
  await expect(close).toBeFocused();
  await expect(reopen).toBeHidden();
  await expect.poll(aspect).toBeCloseTo(free, 1);
  const reactor = await app.reactor();
  expect(reactor.length / 66).toBeGreaterThan(135);
  expect(reactor.every(Number.isFinite)).toBe(true);

  // Under the skeleton is the picture of the same moment, whatever the browser shows of a video that stands still.
  const opacity = () =>
    panel
      .locator('canvas')
      .evaluate((canvas: HTMLCanvasElement) => canvas.getContext('2d')!.getImageData(0, 0, 1, 1).data[3]);
  await expect.poll(opacity).toBe(255);
  await page.keyboard.press('Space');
  await expect.poll(opacity, 'the video itself is seen while it plays').toBe(0);
  await page.keyboard.press('Space');
  await expect.poll(opacity).toBe(255);

  // By keyboard too.
  await panel.getByText('Correct the motion').press('Space');
  await expect(panel.getByLabel('Height of the dancer')).toBeVisible();
  await panel.getByText('Correct the motion').press('Space');
  await panel.getByLabel('Skeleton over the video').press('Space');
  await expect(panel.getByLabel('Skeleton over the video')).not.toBeChecked();
  expect(await app.read(({ playback }) => playback.playing)).toBe(false);

  // Its sound is the song after one click.
  await panel.getByRole('button', { name: 'Use its sound as the song' }).click();
  await expect(close).toBeFocused();
  await app.until(({ reaction }) => reaction?.inputs.song?.name === 'dance.webm');
  const song = await app.read(({ song, shift }) => ({ ...song!.data, sound: null, shift }));
  expect(song.duration).toBeCloseTo(5, 0);
  expect(song.silent).toBe(false);
  // It begins with the video, and the dance with the first picture of the dancer.
  expect(Math.abs(song.shift)).toBeLessThanOrEqual(3);

  await page.getByRole('button', { name: 'Download', exact: true }).click();
  await page.getByRole('radio', { name: /As on stage/ }).click();
  await page.getByRole('checkbox', { name: 'Show the leader’s video beside it' }).press('Space');
  const besideEachOther = async (): Promise<void> => {
    const coming = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save video' }).click();
    const [left, right] = await halvesOf(page, await (await coming).path());
    // The studio is bright, and the stage is dark.
    expect(left).toBeGreaterThan(right + 25);
    await page.keyboard.press('Escape');
  };
  await besideEachOther();
  // And in a loop, whose first picture is in the middle of the video.
  await app.drawLoop(75, 105);
  await page.keyboard.press('e');
  await page.getByRole('radio', { name: 'Loop' }).click();
  await besideEachOther();

  // What can't be read is a sentence, and the leader stays with its video.
  await app.drop({
    name: 'broken.mp4',
    mimeType: 'video/mp4',
    buffer: Buffer.from('\0\0\0\x20ftypisom and no more'),
  });
  await expect(app.alert).toHaveAttribute('data-code', 'not-a-video');
  expect(await app.read(({ leader }) => leader?.name)).toBe('dance.webm');
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/);
  await expect(lane).toBeVisible();

  // Only its motion is stored, and who comes back is told so where the video could be chosen.
  await page.reload();
  await app.until(({ leader, restoring }) => leader?.name === 'dance.webm' && !restoring);
  await expect(panel).toBeHidden();
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  await expect(page.getByText('The leader’s video was not kept.')).toBeVisible();
  await expect(page.getByRole('checkbox', { name: 'Show the leader’s video beside it' })).toBeHidden();
});

test('a video outlasts the demo that comes while it is read, and gives way to undo and to a newer file', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const buffer = Buffer.from(await studio.call('film', 'salsa', SHOT, 3, { container: 'webm' }), 'base64');
  await studio.close();
  let release = (): void => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route('**/demo/leader.bvh', async (route) => {
    await held;
    await route.continue();
  });
  const app = new App(page);
  await app.openWithoutPicture();
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await app.drop({ name: 'first.webm', mimeType: 'video/webm', buffer });
  await expect(panel.getByRole('progressbar')).toBeVisible();
  release();
  await app.until(({ leader }) => leader?.label === 'demo leader');
  await app.until(({ leader }) => leader?.name === 'first.webm');

  // Undo ends the reading, which is the newest, and no step before it.
  await app.drop({ name: 'undone.webm', mimeType: 'video/webm', buffer });
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await page.keyboard.press('Control+z');
  await expect(panel.getByRole('heading')).toHaveText('first.webm');
  await expect(panel.getByRole('progressbar')).toBeHidden();
  expect(await app.read(({ leader }) => leader?.name)).toBe('first.webm');

  // Another video of the same name, as all recordings have: after undo it is not that of the leader.
  const steps = await app.read(({ history }) => history.past.length);
  await app.drop({ name: 'first.webm', mimeType: 'video/webm', buffer });
  await app.until(({ history, job }, before) => history.past.length > before && !job, steps);
  await page.keyboard.press('Control+z');
  await expect(panel).toHaveCount(0);
  expect(await app.read(({ leader }) => leader?.name)).toBe('first.webm');

  await app.drop({ name: 'second.webm', mimeType: 'video/webm', buffer });
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.until(({ leader }) => leader?.name === 'mine.bvh');
  await expect(panel).toHaveCount(0);
});
