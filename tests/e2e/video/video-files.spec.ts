/** What videos are read, and what is said of those that are not. */
import type { Browser, Locator } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import type { Shot } from '../../web/support/filmed/shots';
import { openStudio, patched, SHOT } from '../support/video-files';
import type { VideoFormat } from '../support/video-page/film';

/** Videos by the problem that is told of them. */
async function refusedVideos(browser: Browser): Promise<Readonly<Record<string, Buffer>>> {
  const studio = await openStudio(browser);
  const bytes = (base64: string): Buffer => Buffer.from(base64, 'base64');
  const blank = async (colour: string, container: 'webm' | 'mp4'): Promise<Buffer> =>
    bytes(await studio.call('blank', colour, 1, { container }));
  const mp4 = await blank('#2244aa', 'mp4');
  const upper: Shot = { ...SHOT, position: [0, 1.6, 1.6], target: [0, 1.6, 0] };
  const codec = mp4.indexOf('vp09');
  const refused = {
    'video-black': await blank('#000', 'webm'),
    'no-person': await blank('#2244aa', 'webm'),
    'half-a-body': bytes(await studio.call('film', 'salsa', upper, 1.6)),
    // A codec that no browser has.
    'video-codec': Buffer.from(mp4).fill('qqqq', codec, codec + 4),
    // Each picture is said to last twelve minutes.
    'video-too-long': patched(mp4, 'stts', (content) => {
      const timescale = mp4.readUInt32BE(mp4.indexOf('mdhd') + 16);
      for (let entry = 0; entry < content.readUInt32BE(4); entry++)
        content.writeUInt32BE(720 * timescale, 12 + 8 * entry);
    }),
    'not-a-video': mp4.subarray(0, 40),
    'video-damaged': patched(mp4, 'mdat', (content) => content.fill(0xff)),
  };
  await studio.close();
  return refused;
}

test('a video that cannot be a leader is a sentence, and the leader stays', async ({ page, browser }) => {
  const refused = await refusedVideos(browser);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const before = await app.read(({ leader }) => leader?.name);
  for (const [code, buffer] of Object.entries(refused)) {
    const mp4 = buffer.toString('latin1', 4, 8) === 'ftyp';
    await app.drop({
      name: `${code}.${mp4 ? 'mp4' : 'webm'}`,
      mimeType: mp4 ? 'video/mp4' : 'video/webm',
      buffer,
    });
    await expect(app.alert, code).toHaveAttribute('data-code', code);
    expect(await app.read(({ leader }) => leader?.name)).toBe(before);
    await page.keyboard.press('Escape');
    await expect(app.alert).toBeHidden();
  }
});

test('a video in which the sound begins first stays in step with it, and is shown in step', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const format = { container: 'webm', sound: true, begin: 1 } as const;
  const buffer = Buffer.from(await studio.call('film', 'walking', SHOT, 2, format), 'base64');
  await studio.close();
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'late.webm', mimeType: 'video/webm', buffer });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/, { timeout: 60_000 });
  await panel.getByRole('button', { name: 'Use its sound as the song' }).click();
  await app.until(({ song, reading }) => song?.name === 'late.webm' && !reading.song);
  // A second of it is over when the dance begins.
  await app.until(({ shift }) => Math.abs(shift + 30) <= 3);
  const video = panel.locator('video');
  await expect.poll(() => video.evaluate((one: HTMLVideoElement) => one.currentTime)).toBeCloseTo(1, 1);
  // The part that is used is given in the video's own time, and stays when the video is read again.
  await panel.getByText('Correct the motion').click();
  await expect(panel.getByLabel('Use from')).toHaveValue('1');
  await expect(panel.getByLabel('Use to')).toHaveValue('3');
});

test('of a file whose end is missing what is there is danced, and the rest is told', async ({
  page,
  browser,
}) => {
  const studio = await openStudio(browser);
  const whole = Buffer.from(await studio.call('film', 'walking', SHOT, 3, { container: 'mp4' }), 'base64');
  await studio.close();
  // The pictures come last.
  const pictures = whole.indexOf('mdat');
  const buffer = whole.subarray(0, Math.round(pictures + 0.7 * (whole.length - pictures)));
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'half.mp4', mimeType: 'video/mp4', buffer });
  const panel = page.getByRole('region', { name: 'Video of the leader' });
  await expect(panel.getByRole('status')).toHaveText(/The dancer is the leader now/, { timeout: 60_000 });
  await expect(panel.getByText(/The file is incomplete: [12]\.\d of 3\.0 s could be read/)).toBeVisible();
});

test('what was cut off a video without a loss is not danced', async ({ browser }) => {
  const studio = await openStudio(browser);
  const seen = async (begin: number) =>
    studio.call('read', await studio.call('film', 'walking', SHOT, 2, { container: 'mp4', begin }));
  const [all, rest] = [await seen(0), await seen(-0.5)];
  await studio.close();
  expect(all.times).toHaveLength(24);
  expect(rest.times).toHaveLength(18);
  expect(rest.times[0]).toBeCloseTo(0, 3);
});

test('rotated pictures, MOV and uneven times at up to 120 pictures a second are read', async ({
  browser,
}) => {
  const studio = await openStudio(browser);
  const seen = async (shot: Shot, format: VideoFormat) =>
    studio.call('read', await studio.call('film', 'walking', shot, 0.5, format));
  const upright = await seen(SHOT, { container: 'webm' });
  const sideways = { ...SHOT, width: SHOT.height, height: SHOT.width, rotation: 90 } satisfies Shot;
  const turned = await seen(sideways, { container: 'mp4' });
  const quick = await seen({ ...SHOT, fps: 120 }, { container: 'mov', uneven: true });
  await studio.close();
  for (const one of [turned, quick]) {
    expect([one.width, one.height]).toEqual([SHOT.width, SHOT.height]);
    expect(Math.min(...one.presence)).toBeGreaterThan(0.5);
    // The same dancer in the same moment at the same place.
    const apart = one.image.slice(0, 66).map((value, i) => Math.abs(value - upright.image[i]!));
    expect(apart.reduce((sum, value) => sum + value, 0) / apart.length).toBeLessThan(8);
  }
  expect(turned.times).toHaveLength(6);
  // At most thirty a second.
  expect(quick.times.length).toBeGreaterThan(10);
  expect(quick.times.length).toBeLessThanOrEqual(21);
  expect(quick.times.every((time, i) => i === 0 || time > quick.times[i - 1]!)).toBe(true);
});

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
  await expect.poll(() => skeletonAt(panel)).toBeLessThan(0.5);
  // The dancers stand beside the video.
  const right = await panel.evaluate(({ offsetLeft, offsetWidth }: HTMLElement) => offsetLeft + offsetWidth);
  await app.until(({ covered }, width) => covered === width, right);
  await panel.getByRole('button', { name: 'Follow another person' }).click();
  const people = panel.getByRole('button', { name: /Follow person \d from the largest/ });
  await expect(people).toHaveCount(2);
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
