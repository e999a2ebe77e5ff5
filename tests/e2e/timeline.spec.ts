import type { Page } from '@playwright/test';
import { bvh, wav } from './support/files';
import { App } from './support/app-page';
import { expect, test } from './support/fixtures';

test.use({ viewport: { width: 1280, height: 720 } });

/** A place on a lane: part of its width, and pixels below its upper edge. */
async function place(page: Page, name: RegExp, part: number, down = 10): Promise<[number, number]> {
  const lane = page.getByRole('region', { name: 'Timeline' }).getByRole('img', { name });
  const box = await lane.boundingBox();
  if (!box) throw new Error(`No lane ${String(name)}`);
  return [box.x + part * box.width, box.y + down];
}

async function drag(
  page: Page,
  from: readonly [number, number],
  to: readonly [number, number],
): Promise<void> {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move((from[0] + to[0]) / 2, to[1]);
  await page.mouse.move(...to);
}

async function tenSeconds(page: Page): Promise<App> {
  const app = new App(page);
  await app.openWithoutPicture();
  // Two steps and two beats a second, not at the same moments.
  await app.drop(bvh({ frames: 300, name: 'mine.bvh' }), wav({ seconds: 10, name: 'mine.wav' }));
  await app.until(({ song, leader }) => song?.name === 'mine.wav' && leader?.name === 'mine.bvh');
  await app.reaction('mine.bvh');
  await app.until(({ reaction, song }) => song && reaction?.inputs.song === song);
  return app;
}

/** Above the leader's lane lie the song, 4 + 46 px, and the ruler. */
const RULER = -60;

test('a part is looped: drawn on the ruler, changed by its handles and by keys', async ({ page }) => {
  const app = await tenSeconds(page);
  const region = () => app.read(({ playback }) => playback.region);

  await drag(page, await place(page, /^Leader/, 0.2, RULER), await place(page, /^Leader/, 0.3, RULER));
  expect(await region(), 'it holds once the pointer is up').toBeNull();
  await page.mouse.up();
  const drawn = await region();
  expect(drawn?.from).toBeCloseTo(2, 1);
  expect(drawn?.to).toBeCloseTo(3, 1);
  expect(await app.read(({ playback }) => playback.loop)).toBe(true);
  await expect(page.getByRole('button', { name: /^Loop 0:0/ })).toHaveAttribute('aria-pressed', 'true');

  await drag(page, await place(page, /^Leader/, 0.21, RULER), await place(page, /^Leader/, 0.62, RULER));
  expect(await page.evaluate('getSelection().toString()'), 'no text is selected').toBe('');
  await page.keyboard.press('Escape');
  await page.mouse.up();
  expect(await region()).toEqual(drawn);

  await page.getByRole('slider', { name: 'Loop end' }).focus();
  await page.keyboard.press('ArrowLeft');
  expect((await region())?.to).toBeCloseTo((drawn?.to ?? 0) - 1 / 30, 3);
  await drag(page, await place(page, /^Leader/, 0.2, RULER), await place(page, /^Leader/, 0.24, RULER));
  await page.mouse.up();
  expect((await region())?.from, 'the nearest beat').toBeCloseTo(2.5, 1);

  const { to } = (await region())!;
  await page.getByRole('slider', { name: 'Loop start' }).focus();
  for (let frame = 0; frame < 20; frame++) await page.keyboard.press('ArrowRight');
  expect(await region(), 'an end stops at the other one').toEqual({ from: to - 0.2, to });
  await page.keyboard.press('Shift+ArrowLeft');

  await page.evaluate('document.activeElement.blur()');
  await page.keyboard.press('Home');
  await page.evaluate(`
    window.times = [];
    (function check() {
      window.times.push(window.reactdance.store.getState().playback.time);
      requestAnimationFrame(check);
    })();
  `);
  await page.keyboard.press('Space');
  await expect
    .poll(() =>
      page.evaluate<number>('window.times.filter((t, i) => i > 0 && t < window.times[i - 1] - 0.3).length'),
    )
    .toBeGreaterThanOrEqual(2);
  expect(await page.evaluate<number>('Math.max(...window.times)')).toBeLessThan(3.4);
  // A key that is held repeats itself.
  for (const press of ['down', 'down', 'up'] as const) await page.keyboard[press]('Space');
  expect(await app.read(({ playback }) => playback.playing)).toBe(false);

  await page.keyboard.press('Escape');
  expect(await app.read(({ playback }) => [playback.region, playback.loop])).toEqual([null, false]);

  await page.keyboard.press('Home');
  const ends: number[] = [];
  for (const key of ['i', 'o']) {
    await page.keyboard.press('Shift+ArrowRight');
    ends.push(await app.read(({ playback }) => playback.time));
    await page.keyboard.press(key);
  }
  expect(await region()).toEqual({ from: ends[0], to: ends[1] });
  expect(ends[0]).toBeLessThan(ends[1] ?? 0);
  await page.keyboard.press('l');
  expect(await app.read(({ playback }) => [playback.region !== null, playback.loop])).toEqual([true, false]);

  await page.mouse.dblclick(...(await place(page, /^Leader/, 0.6, RULER)));
  expect(await region()).toBeNull();
});

test('the “1” is set by a click, the count is halved and undone, and loops go from beat to beat', async ({
  page,
}) => {
  const app = await tenSeconds(page);
  const counting = () => app.read(({ countings }) => countings[0]);
  const count = page.getByRole('button', { name: /^Bar .* Count/ });
  const dialog = page.getByRole('dialog', { name: 'How the song is counted' });

  await test.step('the tempo is that of the beats', async () => {
    await expect(page.getByRole('button', { name: /^Song: mine.wav/ })).toHaveText(/ 120 BPM/);
  });

  await test.step('a click on the ruler sets the "1", and does not jump', async () => {
    await count.click();
    await dialog.getByRole('button', { name: 'Click a beat' }).click();
    await page.mouse.click(...(await place(page, /^Leader/, 0.352, RULER)));
    expect((await counting())?.one).toBeCloseTo(3.5, 1);
    expect(await app.read(({ playback }) => playback.time)).toBe(0);
    await page.mouse.click(...(await place(page, /^Leader/, 0.352, RULER)));
    await expect(count).toHaveText(/Count 1$/);
  });

  await test.step('half the tempo, which undo takes back', async () => {
    await count.click();
    await dialog.getByRole('radio', { name: 'Half' }).click();
    await expect(page.getByRole('button', { name: /^Song: mine.wav/ })).toHaveText(/ 60 BPM/);
    await page.keyboard.press('Control+z');
    await expect(page.getByRole('button', { name: /^Song: mine.wav/ })).toHaveText(/ 120 BPM/);
    await page.keyboard.press('Escape');
  });

  await test.step('a loop is drawn from beat to beat, with Alt from any time', async () => {
    const [from, to] = [await place(page, /^Leader/, 0.21, RULER), await place(page, /^Leader/, 0.39, RULER)];
    await drag(page, from, to);
    await page.mouse.up();
    const beats = (await app.read(({ song }) => song?.data.rhythm.beats)) ?? [];
    const region = await app.read(({ playback }) => playback.region);
    expect(beats).toContain(region?.from);
    expect(beats).toContain(region?.to);
    await page.keyboard.down('Alt');
    await drag(page, from, to);
    await page.mouse.up();
    await page.keyboard.up('Alt');
    const free = await app.read(({ playback }) => playback.region);
    expect([free?.from, free?.to].map((time) => time?.toFixed(1))).toEqual(['2.1', '3.9']);
  });
});

test('the lanes zoom around the pointer, scroll, and follow the playhead', async ({ page }) => {
  const app = await tenSeconds(page);
  const zoom = () => app.read(({ zoom }) => zoom);

  await page.mouse.move(...(await place(page, /^Leader/, 0.5)));
  await page.keyboard.down('Control');
  for (let i = 0; i < 4; i++) await page.mouse.wheel(0, -60);
  await page.keyboard.up('Control');
  await expect.poll(async () => (await zoom()) !== null).toBe(true);
  const near = await zoom();
  if (!near) throw new Error('Nothing is zoomed.');
  expect((near.from + near.to) / 2).toBeCloseTo(5, 1);
  expect(near.to - near.from).toBeLessThan(5);

  await page.mouse.click(...(await place(page, /^Leader/, 0.5)));
  expect(await app.read(({ playback }) => playback.time)).toBeCloseTo(5, 1);

  await page.mouse.wheel(0, 100);
  await expect.poll(async () => ((await zoom())?.from ?? 0) > near.from + 0.1).toBe(true);

  await page.keyboard.press('End');
  expect((await zoom())?.to).toBeCloseTo(10, 3);
  await page.keyboard.press('Home');
  expect((await zoom())?.from).toBe(0);
  await page.keyboard.press('0');
  expect(await zoom()).toBeNull();
  await page.keyboard.press('+');
  expect((await zoom())?.to).toBeCloseTo(10 / 1.5, 1);
  await page.keyboard.press('-');
  expect(await zoom()).toBeNull();

  await page.getByRole('slider', { name: 'Timeline zoom' }).fill('100');
  const nearest = await zoom();
  expect((nearest?.to ?? 0) - (nearest?.from ?? 0)).toBeCloseTo(1, 3);
  await page.getByRole('button', { name: 'Show the whole dance' }).click();
  expect(await zoom()).toBeNull();
});

test('the song is shifted by dragging, by keys and by the suggestion, and the reaction is made to the shifted song', async ({
  page,
}) => {
  const app = await tenSeconds(page);
  const shift = () => app.read(({ shift }) => shift);
  const grip = page.getByRole('slider', { name: 'Song shift' });

  await test.step('a click moves the playhead and does not shift the song', async () => {
    await page.mouse.click(...(await place(page, /^Waveform/, 0.25)));
    expect(await app.read(({ playback }) => playback.time)).toBeCloseTo(2.5, 1);
    expect(await shift()).toBe(0);
  });

  await test.step('the suggestion aligns the beats and is not repeated', async () => {
    const align = page.getByRole('button', { name: /^Align/ });
    await expect(align).toHaveText(/^Align [+−]\d+ frames$/);
    const words = (await align.textContent()) ?? '';
    const frames = Number(words.replace('−', '-').replace(/[^\d-]/g, ''));
    expect(Math.abs(frames), 'the nearest of the beats').toBeLessThanOrEqual(8);
    await align.click();
    expect(await shift()).toBe(frames);
    await expect(align).toBeHidden();
    await expect(page.getByText('timing fits')).toBeVisible();
    await app.until(({ reaction, shift }) => reaction?.inputs.shift === shift);
    await page.getByRole('button', { name: /^Song shift .*move it back/ }).click();
    expect(await shift()).toBe(0);
  });

  await test.step('a drag shifts by whole frames', async () => {
    await drag(page, await place(page, /^Waveform/, 0.3), await place(page, /^Waveform/, 0.45));
    await expect(page.getByText(/^\+4\d frames, 1\.\d\d s later$/)).toBeVisible();
    expect(await shift(), 'it holds once the pointer is up').toBe(0);
    await page.mouse.up();
    expect(await shift()).toBe(45);
    await app.until(({ reaction }) => reaction?.inputs.shift === 45);
    await expect(grip).toHaveAttribute('aria-valuetext', '+45 frames, 1.50 s later');
  });

  await test.step('Escape cancels a drag', async () => {
    await drag(page, await place(page, /^Waveform/, 0.3), await place(page, /^Waveform/, 0.6));
    await page.keyboard.press('Escape');
    await page.mouse.up();
    expect(await shift()).toBe(45);
  });

  await test.step('arrow keys shift frame by frame, a double click puts it back', async () => {
    await grip.focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Shift+ArrowLeft');
    expect(await shift()).toBe(34);
    await page.mouse.dblclick(...(await place(page, /^Waveform/, 0.5)));
    expect(await shift()).toBe(0);
  });
});

test('a drag of the song ends where the song has gone meanwhile', async ({ page }) => {
  await page.route('**/demo/*', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 300, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  await app.drop(wav({ seconds: 10, name: 'mine.wav' }));
  await app.until(({ reaction, song, job }) => song && reaction?.inputs.song === song && !job);
  await drag(page, await place(page, /^Waveform/, 0.3), await place(page, /^Waveform/, 0.45));
  const dragged = page.getByText(/frames, .* s later$/);
  await expect(dragged).toBeVisible();
  await page.keyboard.press('Control+z');
  expect(await app.read(({ song }) => song)).toBeNull();
  await page.mouse.up();
  await expect(dragged).toBeHidden();
  await page.keyboard.press('Control+y');
  await expect(page.getByRole('slider', { name: 'Song shift' })).toHaveAttribute('aria-valuenow', '0');
});
