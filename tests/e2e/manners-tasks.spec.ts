import { App, SHIPPED } from './app-page';
import { expect, test } from './fixtures';
import { tasksOf, TRACED } from './main-thread';

test.use({ viewport: { width: 1280, height: 720 }, deviceScaleFactor: 1 });

/** A task of the page's own thread may take this long, milliseconds. */
const LONGEST = 100;
/** `longtask` entries beyond that in one generation, with the picture: where other programs run, some core is taken. */
const HELD_UP = 1;

test('no task of the page is long while a reaction is made and the picture plays', async ({
  page,
  browser,
}) => {
  const app = new App(page);
  await app.open(SHIPPED);
  await app.settled();
  await page.evaluate('window.reactdance.stage.ready()');
  // However long it takes, the dance goes on.
  await page.keyboard.press('l');
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing && playback.time > 0.2);
  const frames = () => page.evaluate<number>('window.reactdance.stage.stats().frames');
  const before = await frames();
  await browser.startTracing(page, { categories: TRACED });
  await page.evaluate("performance.mark('asked')");
  await page.getByRole('slider', { name: 'Coarse guidance' }).fill('1.7');
  // The page says itself when all is there: asking it again and again would be a task each time.
  await page.evaluate(`new Promise((resolve) => {
    (function look() {
      const { job, reaction, quality } = window.reactdance.store.getState();
      const made = !job && quality && reaction.inputs.settings.guidance.upper.coarse === 1.7;
      if (made) resolve(performance.mark('shown'));
      else setTimeout(look, 50);
    })();
  })`);
  const tasks = tasksOf(await browser.stopTracing(), 'asked', 'shown');
  const drawn = (await frames()) - before;
  expect(await app.read(({ playback }) => playback.playing)).toBe(true);
  expect(drawn).toBeGreaterThan(3);

  const longest = (of: (task: (typeof tasks)[number]) => number): number =>
    Math.round(Math.max(...tasks.map(of)));
  const held = tasks.filter(({ whole }) => whole > LONGEST);
  test.info().annotations.push({
    type: 'measured',
    description:
      `${tasks.length} tasks, ${drawn} pictures; longest: busy ${longest(({ busy }) => busy)} ms, ` +
      `from beginning to end ${longest(({ whole }) => whole)} ms, of which waiting for a picture ` +
      `${longest(({ waited }) => waited.onScreen)} ms; ${held.length} over ${LONGEST} ms`,
  });
  expect(longest(({ busy }) => busy)).toBeGreaterThan(0);
  expect(tasks.filter(({ busy }) => busy > LONGEST)).toEqual([]);
  expect(held.length).toBeLessThanOrEqual(HELD_UP);
  // Without a graphics card the browser fetches each picture from the processor that draws it, and waits for it while
  // it puts the page together: time in which the page does nothing. Nothing of ours makes the thread wait.
  expect(tasks.filter(({ waited }) => waited.inScripts > 20)).toEqual([]);
});
