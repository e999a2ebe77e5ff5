import { readFile } from 'node:fs/promises';
import type { Download, Page } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { probe } from '../support/ffprobe';
import { demoSettings as settings, serveDemo } from '../support/made-demo';
import { rested } from '../support/stage-rest';
import { openWritten } from '../support/written-video';

const FRAMES = 24;
const PREFIX = 'made-demo-song_made-demo-leader_demo-reaction_s77_c0.50-f0.25-m1.50_footlock';

// A small stage, for a software renderer; an odd one, which encoders do not take.
test.use({ viewport: { width: 481, height: 580 } });

async function openMenu(page: Page, frames = FRAMES): Promise<App> {
  await serveDemo(page, settings, frames);
  const app = new App(page);
  await app.open();
  await app.settled();
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  return app;
}

async function saveVideo(page: Page): Promise<Download> {
  await page.getByRole('radio', { name: /As on stage/ }).click();
  const coming = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save video' }).click();
  return coming;
}

/** Moves the song by whole frames, and waits for the reaction to it. */
async function shiftSong(page: Page, app: App, frames: number): Promise<void> {
  await page.keyboard.press('Escape');
  const narrow = page.viewportSize()!;
  // Phones have no handle for it.
  await page.setViewportSize({ ...narrow, width: 1000 });
  const grip = page.getByRole('slider', { name: 'Song shift' });
  for (let frame = 0; frame < frames; frame++) await grip.press('ArrowRight');
  await app.until(({ reaction, job }, shift) => reaction?.inputs.shift === shift && !job, frames);
  await page.setViewportSize(narrow);
  await page.getByRole('button', { name: 'Download', exact: true }).click();
}

/** Picture and sound of a video. */
interface VideoContent {
  /** Shares of warm and cool pixels in the middle frame. */
  readonly warm: number;
  readonly cool: number;
  readonly loudest: number;
  /** Start of the sound, seconds. */
  readonly soundStart: number;
}

async function contentOf(page: Page, file: string): Promise<VideoContent> {
  const written = await openWritten(page, file);
  return written.evaluate(async ({ video, bytes }) => {
    const context = new OffscreenCanvas(video.videoWidth, video.videoHeight).getContext('2d');
    if (!context) throw new Error('There is no 2D context to read the video with.');
    context.drawImage(video, 0, 0);
    const { data } = context.getImageData(0, 0, video.videoWidth, video.videoHeight);
    let [warm, cool] = [0, 0];
    for (let i = 0; i < data.length; i += 4) {
      const [red = 0, green = 0, blue = 0] = [data[i], data[i + 1], data[i + 2]];
      if (red >= 90 && red >= 1.3 * green && green >= blue) warm += 4 / data.length;
      if (blue >= 90 && blue >= 1.3 * red) cool += 4 / data.length;
    }
    const sound = await new OfflineAudioContext(1, 1, 48000).decodeAudioData(bytes.buffer);
    const samples = sound.getChannelData(0).map(Math.abs);
    const loudest = samples.reduce((most, sample) => Math.max(most, sample), 0);
    return {
      warm,
      cool,
      loudest,
      soundStart: samples.findIndex((sample) => sample > 0.2 * loudest) / 48000,
    };
  });
}

test('a video has every frame and the song, and the stage is unchanged', async ({ page }) => {
  // As in Safari 18, which can encode video but no audio: the page has an encoder of its own.
  await page.addInitScript(() => {
    Reflect.deleteProperty(globalThis, 'AudioEncoder');
    // And as on a phone, where the system can share videos; Chromium on a desktop cannot.
    Object.assign(navigator, {
      canShare: ({ files }: { files: File[] }) => files.every(({ type }) => type.startsWith('video/')),
      share: ({ files }: { files: File[] }) => {
        Object.assign(window, { shared: files.map(({ name, size, type }) => ({ name, size, type })) });
        return Promise.resolve();
      },
    });
  });
  const app = await openMenu(page);
  // With a software renderer full HD would take minutes, so it is not the default.
  await expect(page.getByRole('radio', { name: /As on stage/ })).toBeChecked();
  const size = await page.evaluate('window.reactdance.stage.pictureSize()');
  const even = (pixels: number): number => 2 * Math.round(pixels / 2);
  const { width, height } = size as { width: number; height: number };
  const region = page.getByRole('region', { name: 'Video' });
  await expect(region).toContainText(`MP4, ${even(width)} × ${even(height)}`);
  const before = await app.onScreen();
  const download = await saveVideo(page);
  expect(download.suggestedFilename()).toBe(`${PREFIX}_stage.mp4`);
  const { format, streams } = await probe(await download.path());
  expect(format.format_name).toContain('mp4');
  expect(Number(format.duration)).toBeCloseTo(FRAMES / 30, 1);
  const [video, audio] = streams;
  expect(video).toMatchObject({ codec_name: 'h264', nb_read_frames: String(FRAMES) });
  expect([video?.width, video?.height]).toEqual([even(width), even(height)]);
  expect(audio).toMatchObject({ codec_type: 'audio', codec_name: 'aac', channels: 1 });
  const { warm, cool, loudest, soundStart } = await contentOf(page, await download.path());
  expect(warm).toBeGreaterThan(0.001);
  expect(cool).toBeGreaterThan(0.001);
  expect(loudest).toBeGreaterThan(0.2);
  // The song begins with a kick; a twentieth of a second is not noticed.
  expect(soundStart).toBeLessThan(0.05);
  await expect(region).toContainText(/Saved, \d+ KB/);
  await region.getByRole('button', { name: 'Share the video' }).click();
  expect(await page.evaluate('window.shared')).toEqual([
    { name: `${PREFIX}_stage.mp4`, size: Number(format.size), type: 'video/mp4' },
  ]);
  expect(await app.onScreen()).toEqual(before);
  expect(await page.evaluate('window.reactdance.stage.pictureSize()')).toEqual(size);
});

/** Shares of warm and cool pixels, and the middles of both as shares of width and height. */
function coloursOf(page: Page, png: Buffer): Promise<Record<'warm' | 'cool', [number, number, number]>> {
  return page.evaluate(async (bytes) => {
    const png = Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([png]));
    const { width, height } = picture;
    const context = new OffscreenCanvas(width, height).getContext('2d')!;
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const found: Record<'warm' | 'cool', [number, number, number]> = { warm: [0, 0, 0], cool: [0, 0, 0] };
    for (let at = 0; at < width * height; at++) {
      const [red = 0, , blue = 0] = data.subarray(4 * at);
      const sums = red >= 90 && red >= 1.3 * blue ? found.warm : blue >= 1.3 * red ? found.cool : null;
      [1, (at % width) / width, Math.floor(at / width) / height].forEach(
        (value, i) => sums && (sums[i]! += value),
      );
    }
    for (const sums of [found.warm, found.cool]) {
      for (const i of [1, 2]) sums[i]! /= sums[0];
      sums[0] /= width * height;
    }
    return found;
  }, png.toString('base64'));
}

test('a picture shows the moment of the stage as its camera sees it', async ({ page }) => {
  await page.setViewportSize({ width: 900, height: 820 });
  const app = await openMenu(page, 60);
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Play the demo' }).click();
  await app.until(({ playback }) => playback.playing);
  await page.keyboard.press('Space');
  await page.keyboard.press('End');
  // From the side and near: nothing that a stage would show by itself.
  await page.evaluate('window.reactdance.stage.stepCamera(1, 0.8)');
  await rested(page);
  const stage = await page.locator('.stage canvas').screenshot();
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  const coming = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save picture' }).click();
  const download = await coming;
  expect(download.suggestedFilename()).toBe(`${PREFIX}_at2.0s_stage.png`);
  await expect(page.getByRole('region', { name: 'Video and picture' })).toContainText(/Saved, \d+ KB/);
  const [shown, saved] = [
    await coloursOf(page, stage),
    await coloursOf(page, await readFile(await download.path())),
  ];
  // Words on the stage have the dancers' colours too, mostly the reactor's.
  const [share, x, y] = shown.cool;
  expect(Math.abs(saved.cool[0] / share - 1)).toBeLessThan(0.1);
  expect(Math.abs(saved.cool[1] - x)).toBeLessThan(0.02);
  expect(Math.abs(saved.cool[2] - y)).toBeLessThan(0.02);
  expect(saved.warm[0]).toBeGreaterThan(0.003);
});

/** The pixels of the reactor, in warm colours, at a moment of a video, from the middle of all of them. */
async function reactorAt(page: Page, file: string, seconds: number): Promise<Set<string>> {
  const written = await openWritten(page, file);
  const pixels = await written.evaluate(async ({ video }, seconds) => {
    const seeked = new Promise((resolve) => (video.onseeked = resolve));
    video.currentTime = seconds;
    await seeked;
    const [width, height] = [video.videoWidth, video.videoHeight];
    const context = new OffscreenCanvas(width, height).getContext('2d')!;
    context.drawImage(video, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const warm: [number, number][] = [];
    for (let at = 0; at < width * height; at++)
      if (data[4 * at]! >= 90 && data[4 * at]! >= 1.3 * data[4 * at + 2]!)
        warm.push([at % width, Math.floor(at / width)]);
    return warm;
  }, seconds);
  const middle = [0, 1].map((axis) => pixels.reduce((sum, pixel) => sum + pixel[axis]!, 0) / pixels.length);
  return new Set(pixels.map((pixel) => pixel.map((value, axis) => Math.round(value - middle[axis]!)).join()));
}

/** Share of the pixels of either that both have. */
function overlap(one: ReadonlySet<string>, other: ReadonlySet<string>): number {
  const both = [...one].filter((pixel) => other.has(pixel)).length;
  return both / (one.size + other.size - both);
}

test('the sound of a video begins where the song was shifted to, also in the video of a loop', async ({
  page,
}) => {
  const app = await openMenu(page, 60);
  await shiftSong(page, app, 15);
  const whole = await (await saveVideo(page)).path();
  const { soundStart } = await contentOf(page, whole);
  expect(soundStart).toBeGreaterThan(0.48);
  expect(soundStart).toBeLessThan(0.55);

  await test.step('the video of a loop has its pictures, and the sound begins as much earlier', async () => {
    await page.keyboard.press('Home');
    for (const [frames, button] of [
      [9, 'Start here'],
      [36, 'End here'],
    ] as const) {
      await page.keyboard.press('Escape');
      for (let frame = 0; frame < frames; frame++) await page.keyboard.press('ArrowRight');
      await page.keyboard.press('e');
      await page.getByRole('button', { name: button }).click();
    }
    await expect(page.getByRole('radio', { name: 'Loop' })).toBeChecked();
    const { from, to } = (await app.read(({ playback }) => playback.region))!;
    expect([Math.round(from * 30), Math.round(to * 30)]).toEqual([9, 45]);
    const download = await saveVideo(page);
    expect(download.suggestedFilename()).toMatch(/_\d\.\d-\d\.\ds_stage\.mp4$/);
    const { streams } = await probe(await download.path());
    expect(streams[0]?.nb_read_frames).toBe(String(Math.round((to - from) * 30)));
    const { soundStart } = await contentOf(page, await download.path());
    expect(soundStart).toBeGreaterThan(0.48 - from);
    expect(soundStart).toBeLessThan(0.55 - from);
    // The camera frames the dancers anew where the loop begins, so their places in the pictures differ.
    const [shown, same, other] = [
      await reactorAt(page, await download.path(), 0.51),
      await reactorAt(page, whole, from + 0.51),
      await reactorAt(page, whole, 0.51),
    ];
    expect(overlap(shown, same)).toBeGreaterThan(0.1 + overlap(shown, other));
  });
});

/** The encoder as Firefox has it: its decoder record has the first byte of each parameter set twice. */
const FIREFOX_ENCODER = `{
  const doubled = (record) => {
    const bytes = [...new Uint8Array(record)];
    const end = 8 + (bytes[6] << 8) + bytes[7];
    const set = ([high, low, first, ...rest]) => [high, low + 1, first, first, ...rest];
    const pictures = bytes.slice(end + 1, end + 3 + (bytes[end + 1] << 8) + bytes[end + 2]);
    return new Uint8Array([...bytes.slice(0, 6), ...set(bytes.slice(6, end)), 1, ...set(pictures)]).buffer;
  };
  const Encoder = VideoEncoder;
  VideoEncoder = class extends Encoder {
    constructor({ output, error }) {
      super({
        error,
        output: (chunk, meta) => {
          const config = meta?.decoderConfig;
          if (config) config.description = config.description ? doubled(config.description) : new ArrayBuffer(0);
          output(chunk, meta);
        },
      });
    }
  };
}`;

test('a video that Firefox encodes says how it is decoded as players need it', async ({ page }) => {
  await page.addInitScript(FIREFOX_ENCODER);
  await openMenu(page);
  const download = await saveVideo(page);
  const file = await readFile(await download.path());
  const [version, profile, , , , , , length = 0, ...sets] = file.subarray(file.indexOf('avcC') + 4);
  const SEQUENCE = 0x67;
  expect([version, ...sets.slice(0, 2)]).toEqual([1, SEQUENCE, profile]);
  const PICTURE = 0x68;
  expect([sets[length], sets[length + 3]]).toEqual([1, PICTURE]);
  expect(sets[length + 4]).not.toBe(PICTURE);
  const { streams } = await probe(await download.path());
  expect(streams[0]).toMatchObject({ codec_name: 'h264', nb_read_frames: String(FRAMES) });
});

test('without an H.264 encoder the video is WebM; writing a video does not wait for timers', async ({
  page,
}) => {
  await page.addInitScript(() => {
    const supports = VideoEncoder.isConfigSupported.bind(VideoEncoder);
    VideoEncoder.isConfigSupported = async (config) =>
      config.codec.startsWith('avc1') ? { supported: false, config } : supports(config);
  });
  await page.clock.install();
  await openMenu(page);
  await expect(page.getByRole('region', { name: 'Video' })).toContainText('WebM');
  // From here on the page's clock and timers run a hundred times too slow, and so would all that waits for them.
  await page.clock.pauseAt(new Date(Date.now() + 60_000));
  const pageClock = () => page.evaluate<number>('performance.now()');
  const [begun, begunThere] = [Date.now(), await pageClock()];
  let download: Download | null = null;
  void saveVideo(page).then((done) => (download = done));
  while (!download) {
    // This sets the pace of the page's clock: 5 ms for each half second of the test's.
    await page.waitForTimeout(500);
    await page.clock.runFor(5);
  }
  const [took, tookThere] = [(Date.now() - begun) / 1000, ((await pageClock()) - begunThere) / 1000];
  test.info().annotations.push({
    type: 'measured',
    description: `${FRAMES / 30} s of dance encoded in ${took.toFixed(1)} s, in ${tookThere.toFixed(2)} s of its own`,
  });
  expect(tookThere).toBeLessThan(FRAMES / 30 / 2);
  const done = download as Download;
  expect(done.suggestedFilename()).toBe(`${PREFIX}_stage.webm`);
  const { streams } = await probe(await done.path());
  expect(streams.map(({ codec_name }) => codec_name)).toEqual(['vp9', 'opus']);
  expect(streams[0]?.nb_read_frames).toBe(String(FRAMES));
});

test('a video shows its progress, with the menu closed too, and is cancelled at once', async ({ page }) => {
  const app = await openMenu(page, 1800);
  const button = page.getByRole('button', { name: 'Download', exact: true });
  await page.getByRole('radio', { name: /As on stage/ }).click();
  await page.getByRole('button', { name: 'Save video' }).click();
  await app.until(({ videoProgress }) => videoProgress && videoProgress.frame >= 2);
  await expect(page.getByRole('progressbar', { name: 'Video' })).toBeVisible();
  await expect(page.getByRole('region', { name: 'Video' })).toContainText(/Frame \d+ of 1,800/);
  await page.keyboard.press('Escape');
  await expect(button).toHaveAttribute('title', /Writing the video, \d+ %/);
  await button.click();
  await page.getByRole('button', { name: 'Cancel the video' }).click();
  const left = await app.read(({ videoProgress, problem, saved }) => [videoProgress, problem, saved]);
  expect(left).toEqual([null, null, null]);
  await expect(page.getByRole('progressbar', { name: 'Video' })).toBeHidden();
  await expect(page.getByRole('button', { name: 'Save video' })).toBeFocused();
  await expect(page.getByRole('radio', { name: /As on stage/ })).toBeChecked();

  // Also after a failure, which takes the Cancel button away as well.
  await page.getByRole('button', { name: 'Save video' }).press('Enter');
  await app.until(({ videoProgress }) => videoProgress);
  await page.getByRole('button', { name: 'Cancel the video' }).focus();
  await page.evaluate('VideoEncoder.prototype.encode = () => { throw new Error("out of memory"); }');
  await expect(app.alert).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(page.getByRole('button', { name: 'Save video' })).toBeFocused();
});

/** What the page has done since counting began. */
interface PageWork {
  readonly milliseconds: number;
  /** Frames passed to the encoder. */
  readonly encoded: number;
  /** Frames that the stage on the page has drawn. */
  readonly drawn: number;
  /** Number of changes of the progress on the page. */
  readonly reported: number;
}

test('while a video is written, the stage on the page draws nothing and progress is updated seldom', async ({
  page,
}) => {
  await page.addInitScript(() => {
    const counts = { encoded: 0, reported: 0, framesBefore: 0, since: performance.now() };
    Object.assign(window, { counts });
    globalThis.VideoEncoder = class extends VideoEncoder {
      override encode(...picture: Parameters<VideoEncoder['encode']>): void {
        counts.encoded++;
        super.encode(...picture);
      }
    };
  });
  const app = await openMenu(page, 300);
  await page.keyboard.press('Escape');
  // In a loop: on a busy machine the dance may be over before the video has begun.
  await page.keyboard.press('l');
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await app.until(({ playback }) => playback.playing && playback.loop && playback.time > 0.1);
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  await page.getByRole('radio', { name: /As on stage/ }).click();
  await page.getByRole('button', { name: 'Save video' }).click();
  await app.until(({ videoProgress }) => videoProgress && videoProgress.frame >= 2);
  await page.evaluate(`
    const { counts } = window;
    const framesBefore = window.reactdance.stage.stats().frames;
    Object.assign(counts, { encoded: 0, framesBefore, since: performance.now() });
    const meter = document.querySelector('[role=progressbar][aria-label=Video]');
    const reported = new MutationObserver(() => counts.reported++);
    reported.observe(meter.parentElement, { subtree: true, childList: true, characterData: true });
  `);
  await expect.poll(() => page.evaluate('window.counts.encoded'), { timeout: 60_000 }).toBeGreaterThan(20);
  const work = await page.evaluate<PageWork>(`({
    ...window.counts,
    drawn: window.reactdance.stage.stats().frames - window.counts.framesBefore,
    milliseconds: performance.now() - window.counts.since,
  })`);
  const each = (work.milliseconds / work.encoded).toFixed(0);
  const description = `${each} ms a picture; ${work.reported} times reported, ${work.drawn} drawn on the page`;
  test.info().annotations.push({ type: 'measured', description });
  expect(work.reported).toBeGreaterThan(0);
  expect.soft(work.reported).toBeLessThanOrEqual(1 + work.milliseconds / 400);
  // The camera may still come to rest.
  expect.soft(work.drawn).toBeLessThan(work.encoded / 4);
});

test('without WebCodecs the video is recorded in real time', async ({ page }) => {
  await page.addInitScript(() => {
    Reflect.deleteProperty(globalThis, 'VideoEncoder');
  });
  const app = await openMenu(page, 120);
  await shiftSong(page, app, 30);
  await expect(page.getByRole('region', { name: 'Video' })).toContainText('takes 0:04');
  const download = await saveVideo(page);
  const { soundStart } = await contentOf(page, await download.path());
  // Sound and pictures of a recording are together to a picture, and a processor draws ten a second.
  expect(soundStart).toBeGreaterThan(0.9);
  expect(soundStart).toBeLessThan(1.2);
  const { format, streams } = await probe(await download.path());
  // Recorders leave it out, and then players can't seek.
  expect(Number(format.duration)).toBeCloseTo(4, 0);
  expect(streams.map(({ codec_type }) => codec_type).sort()).toEqual(['audio', 'video']);
  expect(Number(streams.find((stream) => stream.codec_type === 'video')?.nb_read_frames)).toBeGreaterThan(3);
});
