import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import type { Manifest } from '../../web/model/manifest';
import { leaderBvh } from '../web/support/leader-bvh';
import { bvh, wav } from './support/files';
import { App, maxDistance, meanSpeed, SHIPPED } from './support/app-page';
import { expect, test } from './support/fixtures';

/** Real songs and motions, where a checkout has them beside it; they are no part of the project. */
const REAL = path.resolve(import.meta.dirname, '../../../shared/data');

function realFiles(folder: string, ending: RegExp): string[] {
  try {
    return readdirSync(path.join(REAL, folder)).flatMap((name) =>
      ending.test(name) ? [path.join(REAL, folder, name)] : [],
    );
  } catch {
    return [];
  }
}

const file = (from: string) => ({
  name: path.basename(from),
  mimeType: '',
  buffer: readFileSync(from),
});

/** The files of the tiny model: its manifest first, then everything that it lists. */
function modelFiles() {
  const folder = path.resolve(import.meta.dirname, '../fixtures/tiny-model');
  const others = readdirSync(folder).filter((name) => name !== 'manifest.json');
  return ['manifest.json', ...others].map((name) => file(path.join(folder, name)));
}

// A small picture is drawn as truly as a large one, and sooner.
test.use({ viewport: { width: 800, height: 600 } });

test('from a song and a leader to a partner that can be steered and downloaded', async ({ page }) => {
  const app = new App(page);
  await app.open(SHIPPED);

  await test.step('two dropped files are recognised, in any order', async () => {
    await app.drop(
      bvh({ frames: 240, fps: 60, name: 'my leader.bvh' }),
      wav({ seconds: 3, name: 'my song.wav' }),
    );
    await app.reaction('my leader.bvh');
    const facts = page.getByRole('complementary');
    await expect(facts).toContainText('0:04.0, 120 frames');
    await expect(facts).toContainText('to 30 fps');
    // Six beats are too few to be counted.
    await expect(facts).toContainText('no steady beat');
    await expect(facts).toContainText('silence follows');
    await expect(page.getByRole('button', { name: /^Song: my song.wav/ })).toBeVisible();
  });

  const first = await app.reactor();
  await test.step('the reactor moves, in numbers and in the picture', async () => {
    expect(first).toHaveLength(120 * 66);
    expect(first.every(Number.isFinite)).toBe(true);
    expect(meanSpeed(first)).toBeGreaterThan(0.02);
    await page.keyboard.press('Home');
    await page.evaluate('window.reactdance.stage.ready()');
    await expect.poll(async () => (await app.warmPixels()).size, { timeout: 60_000 }).toBeGreaterThan(2000);
    const before = await app.onScreen();
    const seen = await app.warmPixels();
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await app.until(({ playback }) => playback.time > 1);
    await page.keyboard.press('Space');
    await app.until(({ playback }) => !playback.playing);
    expect(maxDistance(before, await app.onScreen())).toBeGreaterThan(0.01);
    const seenNow = await app.warmPixels();
    const moved = [...seenNow].filter((pixel) => !seen.has(pixel)).length;
    expect(moved).toBeGreaterThan(0.02 * seenNow.size);
  });

  await test.step('a moved fader changes the reactor by itself', async () => {
    await page.getByRole('slider', { name: 'Coarse guidance' }).fill('0.5');
    await app.until(({ reaction }) => reaction?.inputs.settings.guidance['upper']?.['coarse'] === 0.5);
    const second = await app.reactor();
    expect(maxDistance(first, second)).toBeGreaterThan(0.01);
  });

  await test.step('so does another seed, and the same seed brings the same reactor back', async () => {
    const seed = await app.read(({ settings }) => settings?.seed);
    const before = await app.reactor();
    await page.getByRole('button', { name: 'New random seed' }).click();
    await app.until(({ reaction, settings }) => reaction?.inputs.settings.seed === settings?.seed);
    expect(maxDistance(before, await app.reactor())).toBeGreaterThan(0.01);
    await page.getByRole('spinbutton', { name: 'Seed' }).fill(String(seed));
    await page.keyboard.press('Enter');
    await app.until(({ reaction, settings }) => reaction?.inputs.settings.seed === settings?.seed);
    expect(maxDistance(before, await app.reactor())).toBeLessThan(1e-6);
  });

  await test.step('the downloaded BVH has the joints on the screen', async () => {
    await page.getByRole('button', { name: 'Download', exact: true }).click();
    const coming = page.waitForEvent('download');
    await page.getByRole('dialog', { name: 'Download' }).getByRole('button', { name: /BVH/ }).click();
    const download = await coming;
    const { seed, music } = (await app.read(({ settings }) => settings))!;
    expect(download.suggestedFilename()).toMatch(
      new RegExp(
        `^my-song_my-leader_take-\\d+_s${seed}_c0.50-f0.00-m${music.toFixed(2)}_footlock_reactor.bvh$`,
      ),
    );
    const { clip, report } = leaderBvh(readFileSync(await download.path(), 'utf8'));
    await page.keyboard.press('Escape');
    expect(report.warnings).toEqual([]);
    expect(clip.frames).toBe(120);
    for (const frame of [0, 37, 90]) {
      await page.keyboard.press('Home');
      await page.evaluate('document.activeElement.blur()');
      for (let i = 0; i < frame; i++) await page.keyboard.press('ArrowRight');
      await app.until(({ playback }, wanted) => Math.abs(playback.time * 30 - wanted) < 0.01, frame);
      const shown = await app.onScreen();
      const read = Array.from(clip.positions.subarray(frame * 66, (frame + 1) * 66));
      expect(maxDistance(shown, read)).toBeLessThan(0.005);
    }
  });
});

test('a leader unlike the dancers of training is named beside their partner', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture(SHIPPED);
  await app.settled();
  const transport = page.getByRole('group', { name: 'Transport' });
  const sentence =
    'This leader moves unlike the dancers that the model learned from: the partner may look odd.';
  await expect(transport).not.toContainText(sentence);
  // No dancer: it throws its straight legs up to its head.
  await app.chooseLeader(bvh({ frames: 120, name: 'made.bvh', sway: 8 }));
  await app.reaction('made.bvh');
  await expect(transport).toContainText(sentence);
  // All of it can be read on a laptop.
  await page.setViewportSize({ width: 1280, height: 720 });
  const note = transport.getByText(sentence);
  expect(
    await note.evaluate(({ scrollHeight, clientHeight, scrollWidth, clientWidth }) => [
      scrollHeight - clientHeight,
      scrollWidth - clientWidth,
    ]),
  ).toEqual([0, 0]);
});

test('playing never stops while a new reaction is made', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.chooseLeader(bvh({ frames: 900, name: 'long.bvh' }));
  await app.reaction('long.bvh');
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing && playback.time > 0.2);
  await page.getByRole('slider', { name: 'Fine guidance' }).fill('0.75');
  const times: number[] = [];
  await expect
    .poll(
      async () => {
        const state = await app.read(({ playback, reaction }) => ({
          ...playback,
          fine: reaction?.inputs.settings.guidance['upper']?.['fine'],
        }));
        expect(state.playing).toBe(true);
        times.push(state.time);
        return state.fine;
      },
      { timeout: 60_000 },
    )
    .toBe(0.75);
  for (const [i, time] of times.entries()) expect(time).toBeGreaterThanOrEqual(times[i - 1] ?? 0);
});

test('a generation can be cancelled and repeated', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 17_000, name: 'very long.bvh' }));
  await app.until(({ job }) => job?.stage === 'step');
  await expect(page.getByRole('button', { name: 'Cancel' })).toBeVisible();
  await page.keyboard.press('Escape');
  await app.until(({ job }) => job === null);
  await expect(app.progress).toBeHidden();
  expect(await app.read(({ reaction, problem }) => [reaction, problem])).toEqual([null, null]);
  await page.getByRole('slider', { name: 'Coarse guidance' }).fill('0.6');
  await app.until(({ job }) => job?.stage === 'step');
  // Straight to the button: a click that waits for the page to be still may come after the work is done.
  const cancel = page.getByRole('button', { name: 'Cancel' });
  await expect(cancel).toBeVisible();
  await cancel.dispatchEvent('click');
  await app.until(({ job }) => job === null);
  const generate = page.getByRole('button', { name: 'Generate' });
  await generate.press('Enter');
  await expect(cancel).toBeVisible();
  await cancel.focus();
  await cancel.press('Enter');
  await expect(generate).toBeFocused();
  // Nothing is said to be ready: no partner has been made.
  await expect(page.getByRole('status').getByText(/reactor is/)).toHaveCount(0);
  await generate.click();
  await app.reaction('very long.bvh');
  await expect(page.getByText('The reactor is ready.')).toBeAttached();
});

test('the dance is as long as the leader: the rest of a longer song is not used', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(wav({ seconds: 6 }), bvh({ frames: 90, name: 'short.bvh' }));
  await app.reaction('short.bvh');
  await expect(page.getByRole('complementary')).toContainText('The dance ends at 0:03');
  await page.keyboard.press('End');
  expect(await app.read(({ playback }) => playback.time)).toBeCloseTo(3, 3);
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing && playback.time < 1);
  await app.until(({ playback }) => !playback.playing && playback.time > 2.99);
});

test('a wrong frame rate can be corrected on the page', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.chooseLeader(bvh({ frames: 120, fps: 120, name: 'fast.bvh' }));
  await app.reaction('fast.bvh');
  expect(await app.read(({ leader }) => leader?.file.clip.frames)).toBe(30);
  await page.getByRole('combobox', { name: 'Frame rate of the leader file' }).selectOption('60');
  await app.until(({ leader }) => leader?.file.clip.frames === 60);
  await app.reaction('fast.bvh');
  expect(await app.reactor()).toHaveLength(60 * 66);
});

test.describe('real files', () => {
  const leaders = realFiles('bvh', /\.bvh$/);
  const songs = realFiles('music', /\.(ogg|opus|mp3)$/);
  test.skip(leaders.length === 0 || songs.length === 0, 'real data not present');

  test('every real leader gets a partner', async ({ page }) => {
    test.setTimeout(300_000);
    const app = new App(page);
    await app.openWithoutPicture();
    await app.settled();
    for (const leader of leaders) {
      await app.chooseLeader(file(leader));
      await app.reaction(path.basename(leader));
      const reactor = await app.reactor();
      expect(reactor.every(Number.isFinite)).toBe(true);
      expect(meanSpeed(reactor)).toBeGreaterThan(0.02);
    }
  });

  test('a real song is analysed and danced to', async ({ page }) => {
    test.setTimeout(300_000);
    const app = new App(page);
    await app.openWithoutPicture();
    const song = songs.find((name) => name.endsWith('.opus')) ?? songs[0] ?? '';
    await app.drop(file(song), file(leaders[0] ?? ''));
    await app.reaction(path.basename(leaders[0] ?? ''));
    expect(await app.read((state) => state.song?.data.rhythm.beats.length)).toBeGreaterThan(8);
  });
});

test('the visitor’s own model is dropped as a folder and generates at once', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const before = await app.reactor();

  const [manifest, ...graphs] = modelFiles();
  const shipped = JSON.parse(manifest!.buffer.toString()) as Manifest;
  const { coarse, fine } = shipped.guidance;
  const guidance = {
    ...shipped.guidance,
    coarse: { ...coarse, default: 0.5 },
    fine: { ...fine, default: 0.5 },
  };
  const renamed = { ...shipped, name: 'My own duets', guidance };
  const own = { ...manifest!, buffer: Buffer.from(JSON.stringify(renamed)) };

  await app.drop(own, ...graphs.slice(1));
  await expect(app.alert.getByRole('heading')).toContainText(graphs[0]!.name);
  await app.alert.getByRole('button', { name: 'Try again' }).click();
  await expect(app.alert.getByRole('heading'), 'the same folder is tried again').toContainText(
    graphs[0]!.name,
  );
  await page.keyboard.press('Escape');
  expect(maxDistance(before, await app.reactor())).toBe(0);

  await app.drop(own, ...graphs);
  await app.until(({ manifest }) => manifest?.name === 'My own duets');
  await app.until(({ settings, reaction, job }) => !job && settings?.seed === reaction?.inputs.settings.seed);
  expect(await app.read(({ reaction }) => reaction?.inputs.settings.guidance)).toEqual({
    upper: { coarse: 0.5, fine: 0.5 },
    lower: { coarse: 0.5, fine: 0.5 },
    placement: { coarse: 0.5, fine: 0.5 },
  });
  expect(maxDistance(before, await app.reactor())).toBeGreaterThan(1e-4);
  await expect(page.getByRole('list', { name: 'Notes' })).toContainText('My own duets');
});
