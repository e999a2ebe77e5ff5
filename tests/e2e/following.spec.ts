import type { Page } from '@playwright/test';
import { App, SHIPPED } from './support/app-page';
import { expect, test } from './support/fixtures';
import { bvh } from './support/files';

/** Frames of a dance of 69 s. */
const FRAMES = 2066;
const MOVES = 12;

/** What the page saw of a drag; times are milliseconds from the input that was the newest at that moment. */
interface Watched {
  readonly previews: readonly number[];
  readonly wholes: readonly number[];
  /** Moments in which a preview left the frame on view as it was. */
  readonly missed: number;
  /** Moments without playback. */
  readonly stopped: number;
  readonly tasks: readonly number[];
  /** Largest differences between the last preview and the whole after it, one for each frame of the preview, metres. */
  readonly apart: readonly number[];
}

/** Looks at the state after every change, since polling from outside would add tasks to the page. */
const WATCH = `
  window.watched = { previews: [], wholes: [], missed: 0, stopped: 0, tasks: [], apart: [] };
  (() => {
    const { store } = window.reactdance;
    const { watched } = window;
    let input = 0;
    let part = null;
    let last = store.getState();
    addEventListener('input', ({ timeStamp }) => { input = timeStamp; }, true);
    new PerformanceObserver((list) => {
      for (const { duration } of list.getEntries()) watched.tasks.push(Math.round(duration));
    }).observe({ type: 'longtask' });
    const difference = (a, b, frame) => {
      let worst = 0;
      for (let i = frame * 66; i < frame * 66 + 66; i++) worst = Math.max(worst, Math.abs(a[i] - b[i]));
      return worst;
    };
    const look = () => {
      const before = last;
      const now = (last = store.getState());
      if (!now.playback.playing) watched.stopped += 1;
      const shown = ({ preview, reaction }) => (preview ?? reaction).motion.positions;
      if (now.preview && now.preview !== before.preview) {
        watched.previews.push(performance.now() - input);
        const frame = Math.round(now.playback.time * 30);
        part = { before: shown(before), after: shown(now) };
        if (difference(part.before, part.after, frame) === 0) watched.missed += 1;
      }
      if (now.reaction !== before.reaction) {
        watched.wholes.push(performance.now() - input);
        if (part) {
          const frames = Array.from({ length: ${FRAMES} }, (_, frame) => frame);
          const fresh = frames.filter((frame) => difference(part.before, part.after, frame) > 0);
          watched.apart = fresh.map((frame) => difference(part.after, shown(now), frame));
        }
      }
      setTimeout(look, 2);
    };
    look();
  })();
`;

function median(values: readonly number[]): number {
  return values.toSorted((a, b) => a - b)[values.length >> 1] ?? NaN;
}

/** A long dance that plays, with all that the coarse fader needs sampled. */
async function playing(page: Page): Promise<App> {
  const app = new App(page);
  // Without a picture: here the processor would draw it beside the model.
  await app.openWithoutPicture(SHIPPED);
  await app.settled();
  await app.chooseLeader(bvh({ frames: FRAMES, name: 'long.bvh' }));
  await app.reaction('long.bvh');
  await page.getByRole('slider', { name: 'Coarse guidance' }).fill('-0.1');
  await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
  await page.evaluate('document.activeElement.blur()');
  await page.keyboard.press('Home');
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing && playback.time > 1);
  return app;
}

test('the dance goes with a dragged fader, what is in view first, and the drag is one take and one step of undo @alone', async ({
  page,
}) => {
  const app = await playing(page);
  const counts = () => app.read(({ takes, history }) => [takes.length, history.past.length]);
  const before = await counts();
  await page.evaluate(WATCH);
  const slider = await page.getByRole('slider', { name: 'Coarse guidance' }).boundingBox();
  const y = slider!.y + slider!.height / 2;
  const at = (share: number): number => slider!.x + slider!.width * share;
  await page.mouse.move(at(0.5), y);
  await page.mouse.down();
  for (let move = 1; move <= MOVES; move++) {
    const shown = await page.evaluate<number>('window.watched.previews.length');
    // Each more than a step of the fader.
    await page.mouse.move(at(0.5 + (0.49 * move) / MOVES), y);
    await expect
      .poll(() => page.evaluate<number>('window.watched.previews.length'), { intervals: [10] })
      .toBeGreaterThan(shown);
  }
  await page.mouse.up();
  await app.until(({ job, preview, reaction, settings }) => {
    return !job && !preview && reaction?.inputs.settings === settings;
  });
  const watched = await page.evaluate<Watched>('window.watched');
  const [preview, whole] = [median(watched.previews), watched.wholes.at(-1) ?? NaN];
  test.info().annotations.push({
    type: 'measured',
    description:
      `${watched.previews.length} previews, median ${Math.round(preview)} ms after the input; ` +
      `the whole dance ${Math.round(whole)} ms after the last; tasks over 50 ms: ${watched.tasks.join(', ') || 'none'}`,
  });
  expect(watched.previews.length).toBeGreaterThanOrEqual(MOVES);
  expect(watched.missed).toBe(0);
  expect(preview).toBeLessThan(0.7 * whole);
  expect(watched.stopped).toBe(0);
  // The page's thread is free meanwhile; one task may wait for others on a busy machine.
  expect(watched.tasks.filter((duration) => duration > whole / 4).length).toBeLessThanOrEqual(1);
  // Shifts against collisions may have been chosen farther away; all else is as in the whole.
  expect(watched.apart.length).toBeGreaterThan(60);
  expect(median(watched.apart)).toBeLessThan(1e-4);
  expect(await counts()).toEqual(before.map((count) => count + 1));
});

test('of many values in quick succession the newest wins', async ({ page }) => {
  const app = await playing(page);
  const before = await app.reactor();
  const slider = page.getByRole('slider', { name: 'Fine guidance' });
  for (const value of [0.1, 0.3, 0.5, 0.7, 0.9]) await slider.fill(String(value));
  await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
  expect(await app.read(({ reaction }) => reaction?.inputs.settings.guidance['upper']?.['fine'])).toBe(0.9);
  const once = await app.reactor();
  await slider.fill('0');
  await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
  expect(await app.reactor()).toEqual(before);
  await slider.fill('0.9');
  await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
  expect(await app.reactor()).toEqual(once);
});
