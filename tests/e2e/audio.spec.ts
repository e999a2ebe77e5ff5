import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, type Page, test } from '@playwright/test';
import { servePage } from '../../tools/bench/built-page.mjs';
import { agreement, beatAgreement, beatFrames } from '../web/support/audio/feature-parity';
import { fixture, recipe } from '../web/support/audio/audio-fixtures';
import { absence, loadRealSongs, realSongFolder, realSongs } from '../web/support/audio/real-songs';
import type { ErrorData, SongData, Source } from './support/audio-page/main';

/** Seconds of the clicks in the files of tests/fixtures/make_audio.py. */
const CLICK_TIMES = [0.2, 0.5, 0.75, 1.1];

/** The project's own song of ten seconds, at the recipe's rate. */
const SONG = '/fixtures/drums-and-harmony.wav';

let site: Awaited<ReturnType<typeof servePage>>;

test.beforeAll(async () => {
  const root = fileURLToPath(new URL('support/audio-page', import.meta.url));
  site = await servePage(root, {
    '/fixtures/': dirname(fixture('golden.json')),
    '/songs/': realSongFolder,
  });
});
test.afterAll(() => site.close());
test.beforeEach(({ page }) => page.goto(site.url));

/** Calls the page's helper. As an expression: the page's policy forbids functions made at run time. */
function call<T>(page: Page, name: string, ...values: unknown[]): Promise<T> {
  return page.evaluate<T>(`audio.${name}(${values.map((value) => JSON.stringify(value)).join(', ')})`);
}

async function load(page: Page, source: Source): Promise<SongData> {
  const result = await call<SongData | { error: ErrorData }>(page, 'load', source, recipe);
  if ('error' in result) throw new Error(`${result.error.code}: ${result.error.message}`);
  return result;
}

async function refusal(page: Page, source: Source, abortAt?: number): Promise<ErrorData> {
  const values = [source, recipe, ...(abortAt === undefined ? [] : [abortAt])];
  const result = await call<SongData | { error: ErrorData }>(page, 'load', ...values);
  if (!('error' in result)) throw new Error('the song was accepted');
  return result.error;
}

test.describe('decoding', () => {
  for (const ending of ['flac', 'mp3', 'ogg', 'opus', 'm4a']) {
    test(`${ending}: the clicks are where the file has them`, async ({ page }) => {
      const song = await load(page, { url: `/fixtures/clicks.${ending}` });
      expect(song.clicks).toHaveLength(CLICK_TIMES.length);
      // A frame lasts 33 ms; what encoders put before a song is 25 ms and more.
      song.clicks.forEach((click, index) =>
        expect(Math.abs(click - CLICK_TIMES[index]!)).toBeLessThan(0.003),
      );
      expect(Math.abs(song.duration - 1.4)).toBeLessThan(0.03);
      expect(song.frames).toBe(1 + Math.floor(song.samples / recipe.hop));
      expect(song.columns).toBe(recipe.features);
      // 0.8 on the left and half of it on the right, after the first quarter of a period.
      expect(song.peak).toBeGreaterThan(0.5);
      expect(song.peak).toBeLessThan(0.65);
    });
  }

  test('wav: a song is analysed with progress, while the page stays responsive', async ({ page }) => {
    const song = await load(page, { url: SONG });
    expect(song.samples).toBe(10 * recipe.sample_rate);
    expect(song.tempo).toBeCloseTo(112, 0);
    expect(song.beats).toBeGreaterThan(14);
    expect(song.silent).toBe(false);
    expect(song.progress[0]).toBe(0);
    expect(song.progress.at(-1)).toBe(1);
    expect(song.progress.length).toBeGreaterThan(20);
    expect(song.progress).toEqual(song.progress.toSorted((a, b) => a - b));
    expect(song.maxFrameInterval).toBeLessThan(0.5 * song.seconds);
  });

  test('a song that was loaded before comes from the cache', async ({ page }) => {
    await load(page, { url: SONG });
    const again = await load(page, { url: SONG });
    expect(again.progress).toEqual([0, 1]);
  });

  test('a silent song is accepted and flagged', async ({ page }) => {
    const song = await load(page, { silentSeconds: 3, rate: 44100 });
    expect(song).toMatchObject({ silent: true, tempo: 0, beats: 0, duration: 3, frames: 91 });
  });
});

test.describe('a real file has the same features as in Python', () => {
  test.skip(absence !== null, absence ?? '');

  // One at 44.1 and one at 48 kHz, so that both ways to the recipe's rate are taken.
  for (const ending of ['.ogg', '.opus']) {
    test(ending, async ({ page }) => {
      test.setTimeout(300_000);
      const name = realSongs.find((song) => song.endsWith(ending))!;
      const [reference] = loadRealSongs([name]);
      const heard = await load(page, { url: `/songs/${encodeURIComponent(name)}` });
      expect(Math.abs(heard.samples - reference!.audio.length)).toBeLessThanOrEqual(1);
      const rows = Math.min(heard.frames, reference!.features.length / recipe.features);
      const [ours, theirs] = [await call<number[]>(page, 'features'), reference!.features].map((values) =>
        Float32Array.from(values).subarray(0, rows * recipe.features),
      ) as [Float32Array, Float32Array];
      for (const { group, correlation, difference } of agreement(ours, theirs, recipe)) {
        expect.soft(correlation, `correlation of ${group}`).toBeGreaterThanOrEqual(0.999);
        expect.soft(difference, `difference of ${group}`).toBeLessThanOrEqual(0.01);
      }
      expect(beatAgreement(beatFrames(ours, recipe), beatFrames(theirs, recipe), 1)).toBeGreaterThanOrEqual(
        0.95,
      );
    });
  }
});

test('an MP3 that begins with silence is not taken for a much longer one', async ({ page }) => {
  expect((await load(page, 'quietly begun MP3')).duration).toBeCloseTo(120, 0);
});

test.describe('refusals', () => {
  test('an empty file', async ({ page }) => {
    expect(await refusal(page, { text: '' })).toMatchObject({ name: 'AppError', code: 'empty-file' });
  });

  test('a file that is no sound', async ({ page }) => {
    const error = await refusal(page, { text: 'HIERARCHY\nROOT Hips\n' });
    expect(error).toMatchObject({ name: 'AppError', code: 'not-audio' });
    expect(error.hint).toContain('WAV');
  });

  test('a WAV without samples', async ({ page }) => {
    const error = await refusal(page, { silentSeconds: 0, rate: 44100 });
    expect(['no-sound', 'not-audio']).toContain(error.code);
  });

  test('twenty minutes', async ({ page }) => {
    const error = await refusal(page, { silentSeconds: 20 * 60, rate: 8000 });
    expect(error).toMatchObject({ code: 'too-long' });
    expect(error.message).toContain('20.0 minutes');
  });

  test('cancelling ends the analysis', async ({ page }) => {
    expect(await refusal(page, { url: SONG }, 0.5)).toMatchObject({ name: 'AbortError' });
    await expect.poll(() => page.workers().length).toBe(0);
  });

  test('a worker whose script does not come, and the next song gets a new one', async ({ page }) => {
    await page.route(/worker-.*\.js/, (route) => route.abort());
    expect(await refusal(page, { url: SONG })).toMatchObject({ name: 'AppError', code: 'page-part-missing' });
    await page.unroute(/worker-.*\.js/);
    expect((await load(page, { url: SONG })).frames).toBe(301);
  });
});

test.describe('the player', () => {
  /** Largest difference in seconds between the player's clock and the page's at the given speed. */
  function drift(readings: [number, number][], speed: number): number {
    const [first] = readings;
    return Math.max(...readings.map(([now, time]) => Math.abs(time - first![1] - (now - first![0]) * speed)));
  }

  /** Whether the song sounds, at the time that the player shows. */
  async function expectSound(page: Page): Promise<void> {
    const [time, heard] = await page.evaluate<[number, number | null]>('[audio.player.time, audio.heard()]');
    expect(heard, 'the song sounds').not.toBeNull();
    expect(Math.abs(heard! - time)).toBeLessThan(0.12);
  }

  test.beforeEach(async ({ page }) => {
    await page.getByRole('button').click();
    await load(page, { url: SONG });
  });

  for (const what of ['song', 'silence'] as const) {
    test(`keeps time with ${what}, at any speed, through pauses and jumps`, async ({ page }) => {
      await call(page, 'setSound', what, 60);
      expect(await call(page, 'play')).toBeNull();
      await call(page, 'watch', 0.5);
      const readings = await call<[number, number][]>(page, 'watch', 1.5);
      expect(readings.length).toBeGreaterThan(5);
      expect(drift(readings, 1)).toBeLessThan(0.08);

      await call(page, 'player.setSpeed', 0.5);
      await call(page, 'watch', 0.5);
      expect(drift(await call(page, 'watch', 1.5), 0.5)).toBeLessThan(0.08);

      await call(page, 'player.seek', 7);
      await call(page, 'watch', 0.3);
      const [[, time]] = (await call<[number, number][]>(page, 'watch', 0.1)) as [[number, number]];
      expect(time).toBeGreaterThan(7);
      expect(time).toBeLessThan(8);
      if (what === 'song') await expectSound(page);
      else expect(await call(page, 'heard')).toBeNull();

      await call(page, 'player.seek', 1);
      await call(page, 'watch', 0.3);
      const [[, back]] = (await call<[number, number][]>(page, 'watch', 0.1)) as [[number, number]];
      expect(back).toBeGreaterThan(1);
      expect(back).toBeLessThan(2);
      if (what === 'song') await expectSound(page);

      await call(page, 'player.pause');
      const still = await call<[number, number][]>(page, 'watch', 0.3);
      expect(new Set(still.map(([, shown]) => shown)).size).toBe(1);
    });
  }

  test('repeats a loop and starts a shifted song at its time', async ({ page }) => {
    await call(page, 'setSound', 'song', 60);
    await call(page, 'player.setSongStart', 0.5);
    await call(page, 'player.setLoop', { from: 3, to: 3.6 });
    expect(await call(page, 'play')).toBeNull();
    const begun = await call<[number, number][]>(page, 'watch', 0.3);
    expect(await call(page, 'heard'), 'silence before the song').toBeNull();
    expect(begun.at(-1)![1]).toBeLessThan(0.5);
    await call(page, 'watch', 0.6);
    const [time, heard] = await page.evaluate<[number, number]>('[audio.player.time, audio.heard()]');
    expect(Math.abs(heard + 0.5 - time)).toBeLessThan(0.12);

    await call(page, 'player.seek', 2.6);
    const readings = await call<[number, number][]>(page, 'watch', 2.5);
    const times = readings.map(([, shown]) => shown);
    expect(Math.max(...times)).toBeLessThan(3.75);
    const turns = times.flatMap((shown, i) => (i > 0 && shown < times[i - 1]! - 0.2 ? [i] : []));
    expect(turns.length).toBeGreaterThanOrEqual(2);
    for (const turn of turns) expect(times[turn]).toBeLessThan(3.2);
    expect(await call(page, 'heard')).toBeGreaterThan(2.4);

    // The other end: what lies past the loop is heard to the end of the dance.
    await call(page, 'player.seek', 5);
    const past = (await call<[number, number][]>(page, 'watch', 0.4)).map(([, shown]) => shown);
    expect(Math.min(...past)).toBeGreaterThanOrEqual(5);
  });

  test('repeats a loop that begins before the song', async ({ page }) => {
    await call(page, 'setSound', 'song', 60);
    await call(page, 'player.setSongStart', 3);
    await call(page, 'player.setLoop', { from: 2.7, to: 3.4 });
    await call(page, 'player.seek', 2.7);
    await call(page, 'play');
    const times = (await call<[number, number][]>(page, 'watch', 2.5)).map(([, time]) => time);
    expect(Math.max(...times)).toBeLessThan(3.55);
    const turns = times.filter((time, i) => i > 0 && time < times[i - 1]! - 0.4);
    expect(turns.length).toBeGreaterThanOrEqual(2);
  });

  test('moves the song while it plays, and keeps the time', async ({ page }) => {
    await call(page, 'setSound', 'song', 60);
    await call(page, 'player.seek', 5);
    await call(page, 'play');
    for (const start of [2, -1, 0.5]) {
      await call(page, 'watch', 0.4);
      const readings = await page.evaluate<[number, number][]>(
        `audio.watch(0.1).then(async (before) => {
          audio.player.setSongStart(${start});
          return [...before, ...(await audio.watch(0.6))];
        })`,
      );
      expect(drift(readings, 1)).toBeLessThan(0.2);
      const [time, heard] = await page.evaluate<[number, number]>('[audio.player.time, audio.heard()]');
      expect(Math.abs(heard + start - time)).toBeLessThan(0.12);
    }
  });

  test('changes the song while it plays, at the same time', async ({ page }) => {
    await call(page, 'setSound', 'silence', 60);
    await call(page, 'player.seek', 3);
    await call(page, 'play');
    await call(page, 'watch', 0.5);
    await call(page, 'setSound', 'song', 60);
    const times = (await call<[number, number][]>(page, 'watch', 2)).map(([, time]) => time);
    expect(times[0]).toBeGreaterThan(3.4);
    expect(times.at(-1)! - times[0]!).toBeGreaterThan(1);
    expect(times.at(-1)! - times[0]!).toBeLessThan(2.2);
    await expectSound(page);
  });

  test('goes on in silence after the song and stops at the end of the dance', async ({ page }) => {
    await call(page, 'setSound', 'song', 11);
    await call(page, 'player.seek', 9.5);
    await call(page, 'play');
    const readings = await call<[number, number][]>(page, 'watch', 3);
    const times = readings.map(([, time]) => time);
    expect(times).toEqual(times.toSorted((a, b) => a - b));
    expect(times.at(-1)).toBe(11);
    const steps = times.slice(1).map((time, i) => time - times[i]!);
    expect(Math.max(...steps)).toBeLessThan(0.3);
  });

  test('reports that the browser refuses to play, and stays paused', async ({ page }) => {
    await call(page, 'setSound', 'nonsense', 10);
    expect(await call(page, 'play')).toMatchObject({ name: 'AppError', code: 'playback-refused' });
    expect(new Set((await call<[number, number][]>(page, 'watch', 0.3)).map(([, time]) => time)).size).toBe(
      1,
    );
  });

  test('reports a song that does not start at its place in the dance', async ({ page }) => {
    await call(page, 'player.setSongStart', 0.3);
    await call(page, 'setSound', 'nonsense', 10);
    expect(await call(page, 'play')).toBeNull();
    await expect.poll(() => call(page, 'failures')).toEqual(['playback-refused']);
    const times = (await call<[number, number][]>(page, 'watch', 0.3)).map(([, time]) => time);
    expect(new Set(times).size).toBe(1);
    expect(times[0]).toBeGreaterThanOrEqual(0.3);
  });

  test('is silent past the end of a dance that is shorter than the song', async ({ page }) => {
    await call(page, 'setSound', 'song', 2);
    await call(page, 'player.seek', 1);
    await call(page, 'play');
    expect((await call<[number, number][]>(page, 'watch', 2)).at(-1)![1]).toBe(2);
    expect(await call(page, 'heard')).toBeNull();
  });
});

test('the test page has the content security policy of the app', async ({ page }) => {
  const response = await page.goto(site.url);
  expect(response?.headers()['content-security-policy']).toContain("media-src 'self' blob:");
});
