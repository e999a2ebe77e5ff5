/** Who in a video is followed, and what their motion is where the camera turns. */
import type { Browser, Locator } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import type { Shot } from '../../web/support/filmed/shots';
import { openStudio, SHOT } from '../support/video-files';

test('who is far from where the dancer was lost is not followed instead', async ({ browser }) => {
  const studio = await openStudio(browser);
  const shot = { ...SHOT, width: 640, height: 320, focal: 300, position: [-0.9, 1.3, 3.2] } satisfies Shot;
  const other = { aside: 1.8 };
  const cast = [{ aside: -0.8, until: 0.8 }, other];
  const seen = await studio.call('read', await studio.call('filmSeveral', 'walking', shot, 1.3, cast));
  const alone = await studio.call('read', await studio.call('filmSeveral', 'walking', shot, 0.5, [other]));
  await studio.close();
  // The other one would be found.
  expect(Math.max(...alone.presence)).toBeGreaterThan(0.5);
  seen.times.forEach((time, row) => {
    if (time < 0.75) expect(seen.presence[row]).toBeGreaterThan(0.5);
    if (time > 0.85) expect(seen.presence[row]).toBe(0);
  });
});

/** Where the skeleton is drawn, as a share of the picture's width. */
function skeletonAt(panel: Locator): Promise<number> {
  return panel.locator('canvas').evaluate((canvas: HTMLCanvasElement) => {
    const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
    let [sum, count] = [0, 0];
    // Yellow on the left of the body, blue on the right.
    const lines = [0xffd166, 0x4cc9f0];
    for (let i = 0; i < data.length; i += 4)
      if (lines.includes((data[i]! << 16) | (data[i + 1]! << 8) | data[i + 2]!)) {
        sum += (i / 4) % canvas.width;
        count++;
      }
    return sum / count / canvas.width;
  });
}

/** A video of two dancers beside each other, so many seconds; the first leaves at `until`, the other comes at `from`. */
async function filmTwo(
  browser: Browser,
  seconds: number,
  { until, from }: { readonly until?: number; readonly from?: number } = {},
): Promise<Buffer> {
  const studio = await openStudio(browser);
  const shot = { ...SHOT, width: 480, height: 320, focal: 300, position: [-0.7, 1.3, 3.2] } satisfies Shot;
  const cast = [
    { aside: -0.8, ...(until !== undefined && { until }) },
    { aside: 0.9, ...(from !== undefined && { from }) },
  ];
  const film = await studio.call('filmSeveral', 'walking', shot, seconds, cast);
  await studio.close();
  return Buffer.from(film, 'base64');
}

test('who comes into the picture later is followed from the moment in which they are chosen, also while it is read', async ({
  page,
  browser,
}) => {
  const buffer = await filmTwo(browser, 4, { until: 9, from: 1 });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'later.webm', mimeType: 'video/webm', buffer });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  const status = panel.getByRole('status');
  const ready = /The dancer is the leader now/;
  const people = panel.getByRole('button', { name: /Follow person \d from the largest/ });
  const moment = panel.getByRole('slider', { name: 'Moment of the video' });
  const another = panel.getByRole('button', { name: 'Follow another person' });
  const frames = () => app.read(({ leader }) => leader?.motion.frames ?? 0);

  await test.step('while it is read', async () => {
    await expect(panel.getByText(/^Reading, /)).toBeVisible({ timeout: 60_000 });
    await another.click();
    await moment.fill('2');
    await expect(people).toHaveCount(2);
    await panel.getByRole('button', { name: 'Keep this person' }).click();
    await expect(people).toHaveCount(0);
    await expect(moment).toBeHidden();
    await expect(status).toHaveText(ready, { timeout: 60_000 });
    await expect.poll(() => skeletonAt(panel)).toBeLessThan(0.5);
    await expect.poll(frames).toBeGreaterThan(100);
  });

  await another.click();
  await expect(people, 'at the start there is one').toHaveCount(1);
  await moment.fill('2');
  await expect(people).toHaveCount(2);
  const places = await people.evaluateAll((all) => all.map(({ style }) => parseFloat(style.left)));
  await people.nth(places[0]! > places[1]! ? 0 : 1).press('Enter');
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await expect(status).toHaveText(ready, { timeout: 60_000 });
  await expect.poll(() => skeletonAt(panel)).toBeGreaterThan(0.5);
  expect(await panel.locator('video').evaluate((one: HTMLVideoElement) => one.currentTime)).toBeCloseTo(2, 1);
  await expect.poll(frames).toBeLessThan(65);
});

test('of several people the largest is followed, and another one who is clicked', async ({
  page,
  browser,
}) => {
  const buffer = await filmTwo(browser, 2);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'two.webm', mimeType: 'video/webm', buffer });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/, { timeout: 60_000 });
  // Nobody was picked, and what became of the video can be read again.
  await expect(panel.getByRole('button', { name: 'Close' })).toBeInViewport({ ratio: 0.95 });
  await expect.poll(() => skeletonAt(panel)).toBeLessThan(0.5);
  // The dancers stand beside the video.
  const right = await panel.evaluate(({ offsetLeft, offsetWidth }: HTMLElement) => offsetLeft + offsetWidth);
  await app.until(({ covered }, width) => covered === width, right);
  await panel.getByRole('button', { name: 'Follow another person' }).click();
  const people = panel.getByRole('button', { name: /Follow person \d from the largest/ });
  await expect(people).toHaveCount(2);
  await expect(panel.locator('.persons')).toBeInViewport({ ratio: 0.95 });
  // A click on the picture, far right: the nearest one is taken.
  const box = (await panel.locator('.persons').boundingBox())!;
  await page.mouse.click(box.x + 0.93 * box.width, box.y + 0.2 * box.height);
  await expect(panel.getByRole('progressbar')).toBeVisible();
  // Cancelled, the person who was followed before is there as they were.
  await panel.getByRole('button', { name: 'Cancel' }).click();
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/);
  await expect.poll(() => skeletonAt(panel)).toBeLessThan(0.5);
  await panel.getByRole('button', { name: 'Follow another person' }).click();
  await expect(people).toHaveCount(2);
  await page.mouse.click(box.x + 0.93 * box.width, box.y + 0.2 * box.height);
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/, { timeout: 60_000 });
  await expect.poll(() => skeletonAt(panel)).toBeGreaterThan(0.5);
  await panel.getByRole('button', { name: 'Close' }).click();
  await app.until(({ covered }) => covered === 0);
});

/** How far the pelvis goes over the floor, in steps of half a second, metres. */
function pathLength(positions: ArrayLike<number>, seconds: number): number {
  const width = 22 * 3;
  let sum = 0;
  for (let frame = 15; frame < 30 * seconds; frame += 15) {
    const [now, before] = [frame * width, (frame - 15) * width];
    sum += Math.hypot(positions[now]! - positions[before]!, positions[now + 2]! - positions[before + 2]!);
  }
  return sum;
}

test('a camera in a hand that follows the dancer does not make them walk, and the panel says that it turned', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const shot = { ...SHOT, panned: 12 } satisfies Shot;
  const buffer = Buffer.from(await studio.call('film', 'salsa', shot, 3), 'base64');
  const truth = await studio.call('truth', 'salsa');
  await studio.close();
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'held.webm', mimeType: 'video/webm', buffer });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/, { timeout: 60_000 });
  await expect(panel.getByText(/The camera turned by up to 1\d°, which was taken out/)).toBeVisible();
  const found = await app.read(({ leader }) => [...leader!.motion.positions]);
  const share = pathLength(found, 2.5) / pathLength(truth, 2.5);
  expect(share).toBeGreaterThan(0.6);
  expect(share).toBeLessThan(1.6);
});

test('of a video with a cut the longest part is used, until another one is chosen', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const shot = { ...SHOT, cut: { at: 1.25, position: [-2, 1.2, 2], target: [0.3, 0.9, 0] } } satisfies Shot;
  const format = { container: 'webm', sound: true } as const;
  const buffer = Buffer.from(await studio.call('film', 'salsa', shot, 3.5, format), 'base64');
  await studio.close();
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'edited.webm', mimeType: 'video/webm', buffer });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/, { timeout: 60_000 });
  await expect(panel.getByText('a cut at 1.3 s. The longest part')).toBeVisible();
  const seconds = (): Promise<number> => app.read(({ leader }) => leader!.motion.frames / 30);
  await expect.poll(seconds).toBeCloseTo(2.2, 1);

  const correct = panel.getByText('Correct the motion', { exact: true });
  await expect(correct).toBeInViewport({ ratio: 1 });
  await correct.click();
  await expect(panel.getByRole('spinbutton', { name: 'Use to' })).toBeInViewport({ ratio: 0.9 });
  const from = panel.getByRole('spinbutton', { name: 'Use from' });
  await expect(from).toHaveValue('1.3');
  const reversed = panel.getByText('The beginning has to lie before the end');
  await from.fill('9');
  await from.press('Tab');
  await expect(reversed).toBeVisible();
  await from.fill('0');
  await from.press('Tab');
  await expect(panel.getByText('There is a cut at 1.3 s in what is used')).toBeVisible();
  await expect(reversed).toBeHidden();
  await expect.poll(seconds).toBeCloseTo(3.4, 1);

  // Undo brings back the part, in step with the video, and what the controls said of it.
  const moment = panel.locator('input[type="range"]');
  await expect(moment).toHaveValue('0');
  await page.keyboard.press('Escape');
  await page.evaluate('document.activeElement.blur()');
  await page.keyboard.press('Control+z');
  await expect.poll(seconds).toBeCloseTo(2.2, 1);
  await expect(moment).toHaveValue('1.3');
  await expect(from).toHaveValue('1.3');
  const height = panel.getByRole('spinbutton', { name: 'Height of the dancer' });
  await height.fill('5');
  await height.press('Tab');
  await expect(panel.getByText('The height has to be between 100 and 230 cm')).toBeVisible();
  expect(await seconds()).toBeCloseTo(2.2, 1);

  // Its sound comes with its moment in one step of undo.
  const song = () => app.read(({ song, shift }) => [song?.name, shift < 0]);
  const before = await song();
  const use = panel.getByRole('button', { name: 'Use its sound as the song' });
  await use.click();
  await expect.poll(song).toEqual(['edited.webm', true]);
  await expect(use).toBeHidden();
  await page.evaluate('document.activeElement.blur()');
  await page.keyboard.press('Control+z');
  await expect.poll(song).toEqual(before);
  await expect(use).toBeVisible();
});

test('a dancer who is small in a wide picture is found, and followed by a click where someone larger is seen', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  // The dancer is a fifth as high as the picture, ten metres away.
  const shot = { ...SHOT, width: 854, height: 480, focal: 640, position: [0, 1.3, 3.2] } satisfies Shot;
  const [near, far] = [{ aside: -1.2 }, { aside: 2.5, away: 7 }];
  const [alone, two] = [
    await studio.call('filmSeveral', 'walking', shot, 2, [far]),
    await studio.call('filmSeveral', 'walking', shot, 2, [near, far]),
  ].map((film) => Buffer.from(film, 'base64'));
  await studio.close();
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  const ready = /The dancer is the leader now; (9\d|100) % of the frames are clearly seen/;

  await app.drop({ name: 'alone.webm', mimeType: 'video/webm', buffer: alone! });
  await expect(panel.getByRole('status')).toHaveText(ready, { timeout: 60_000 });
  await expect(panel.getByText('The dancer is small in the picture')).toBeVisible();
  await expect.poll(() => skeletonAt(panel)).toBeCloseTo(0.68, 1);

  await app.drop({ name: 'two.webm', mimeType: 'video/webm', buffer: two! });
  await app.until(({ leader }) => leader?.name === 'two.webm');
  await expect.poll(() => skeletonAt(panel)).toBeCloseTo(0.22, 1);
  await panel.getByRole('button', { name: 'Follow another person' }).click();
  await expect(panel.getByRole('button', { name: /Follow person \d from the largest/ })).toHaveCount(1);
  const box = (await panel.locator('.persons').boundingBox())!;
  await page.mouse.click(box.x + 0.68 * box.width, box.y + 0.5 * box.height);
  await expect(panel.getByRole('progressbar')).toBeVisible();
  await expect(panel.getByRole('status')).toHaveText(ready, { timeout: 60_000 });
  await expect.poll(() => skeletonAt(panel)).toBeCloseTo(0.68, 1);
});

test('who passes before somebody in other clothes is followed on, and what was seen of that one is left out', async ({
  browser,
}) => {
  const studio = await openStudio(browser);
  const shot = { ...SHOT, width: 480, height: 320, focal: 300, position: [0, 1.3, 3.4] } satisfies Shot;
  // The one in front is larger, so it is followed: to 0.76 of the picture's width in the end.
  const cast = [{ away: 0.3 }, { aside: -1, away: -0.4, passing: 0.5, outfit: 'green' }] as const;
  const seen = await studio.call('read', await studio.call('filmSeveral', 'turning', shot, 4.5, cast));
  await studio.close();
  const rows = [...seen.times.keys()].filter((row) => seen.presence[row]! > 0);
  expect(rows.length / seen.times.length).toBeGreaterThan(0.9);
  const across = (row: number): number => seen.centre[2 * row]! / shot.width;
  const path = rows.map((row) => {
    const x = -1 + 0.5 * seen.times[row]!;
    return Math.abs(across(row) - (0.5 + (shot.focal * x) / 3 / shot.width));
  });
  expect(Math.max(...path.slice(2))).toBeLessThan(0.16);
});
