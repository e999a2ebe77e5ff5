/** What videos are read, and what is said of those that are not. */
import type { Browser } from '@playwright/test';
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
