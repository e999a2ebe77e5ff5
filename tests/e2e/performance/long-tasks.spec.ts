import type { Browser, Page } from '@playwright/test';
import { bvh } from '../support/files';
import { App, SHIPPED } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { type Task, tasksOf, TRACED } from '../support/main-thread';

test.use({ viewport: { width: 1280, height: 720 }, deviceScaleFactor: 1 });

/** Longest duration of a task of the main thread. */
const MAX_TASK_MS = 100;

/** Expression: pixels in each dancer's colour on the stage, and whether the canvas is a 2D copy. */
const READ_PICTURE = `(() => {
  const canvas = document.querySelector('#stage canvas');
  const small = new OffscreenCanvas(160, 90).getContext('2d');
  small.drawImage(canvas, 0, 0, 160, 90);
  const { data } = small.getImageData(0, 0, 160, 90);
  let orange = 0, blue = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i] > data[i + 2] + 60) orange++;
    if (data[i + 2] > data[i] + 60) blue++;
  }
  return { orange, blue, copied: canvas.getContext('2d') !== null, picture: data.join() };
})()`;
interface StagePicture {
  readonly orange: number;
  readonly blue: number;
  readonly copied: boolean;
  readonly picture: string;
}

const drawn = (page: Page) => page.evaluate<number>('window.reactdance.stage.stats().frames');

/** The page with its model and the demo playing, in a loop: however long a test takes, the dance goes on. */
async function dancing(page: Page): Promise<App> {
  const app = new App(page);
  await app.open(SHIPPED);
  await app.settled();
  await page.evaluate('window.reactdance.stage.ready()');
  await page.keyboard.press('l');
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing && playback.time > 0.2);
  return app;
}

/** The tasks and pictures from a click on "Generate again" until the new dance and its quality are there. */
async function whileMade(page: Page, browser: Browser): Promise<{ tasks: Task[]; pictures: number }> {
  const before = await drawn(page);
  await browser.startTracing(page, { categories: TRACED });
  // The page itself waits for the result: polling from here would add a task each time.
  await page.evaluate(`(() => {
    const { store } = window.reactdance;
    const earlier = store.getState();
    performance.mark('asked');
    window.made = new Promise((resolve) => {
      (function check() {
        const { job, reaction, quality } = store.getState();
        const made = !job && quality && quality !== earlier.quality && reaction !== earlier.reaction;
        if (made) resolve(performance.mark('shown'));
        else setTimeout(check, 50);
      })();
    });
  })()`);
  await page.getByRole('button', { name: 'Generate again' }).click();
  await page.evaluate('window.made');
  const tasks = tasksOf(await browser.stopTracing(), 'asked', 'shown');
  return { tasks, pictures: (await drawn(page)) - before };
}

// Beside another test its pictures would wait for the processor.
test('the main thread has no long task while a reaction is made and the dance plays @alone', async ({
  page,
  browser,
}) => {
  const app = await dancing(page);
  const runs: { readonly busy: number; readonly whole: number }[] = [];
  for (let i = 0; i < 5; i++) {
    const { tasks, pictures } = await whileMade(page, browser);
    expect(await app.read(({ playback }) => playback.playing)).toBe(true);
    expect(pictures).toBeGreaterThan(3);

    const longest = (of: (task: Task) => number): number => Math.round(Math.max(...tasks.map(of)));
    const run = { busy: longest(({ busy }) => busy), whole: longest(({ whole }) => whole) };
    runs.push(run);
    expect(run.busy).toBeGreaterThan(0);
    test.info().annotations.push({
      type: 'measured',
      description:
        `${tasks.length} tasks, ${pictures} pictures; longest: busy ${run.busy} ms, ` +
        `from beginning to end ${run.whole} ms, of which waiting for a picture ` +
        `${longest(({ waited }) => waited.onScreen)} ms on its way to the screen and ` +
        `${longest(({ waited }) => waited.inScripts)} ms in scripts`,
    });
  }
  expect(Math.max(...runs.map(({ busy }) => busy))).toBeLessThanOrEqual(MAX_TASK_MS);
  // What the page waits for it waits for each time; other programs interrupt some of its tasks.
  expect(Math.min(...runs.map(({ whole }) => whole))).toBeLessThanOrEqual(MAX_TASK_MS);
});

test('the dancers go on while a reaction is made; without a graphics card the page shows copies of the frames', async ({
  page,
}) => {
  const app = await dancing(page);
  // Long enough for several pictures.
  await app.drop(bvh({ frames: 900, name: 'long.bvh' }));
  await app.reaction('long.bvh');
  await app.settled();
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing && playback.time > 0.2);
  // The page itself looks at every picture: asking from here takes as long as the job.
  await page.evaluate(`
    window.pictures = [];
    (() => {
      const { stage, store } = window.reactdance;
      let last = 0;
      (function look() {
        const { job } = store.getState();
        const { frames } = stage.stats();
        if (job && job.fraction > 0 && frames !== last) window.pictures.push(${READ_PICTURE});
        last = frames;
        setTimeout(look, 20);
      })();
    })();
  `);
  // The mean that another variety needs is that of several dances, the most that a fader has the page sample.
  await page.getByRole('slider', { name: 'Variety' }).fill('1.5');
  await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
  const pictures = await page.evaluate<StagePicture[]>('window.pictures');
  for (const { orange, blue, copied } of pictures) {
    expect(orange).toBeGreaterThan(20);
    expect(blue).toBeGreaterThan(20);
    expect(copied).toBe(true);
  }
  expect(new Set(pictures.map(({ picture }) => picture)).size).toBeGreaterThan(2);

  await app.settled();
  // A moment later the canvas itself is there again, and not empty.
  const readPicture = () => page.evaluate<StagePicture>(READ_PICTURE);
  await expect.poll(async () => (await readPicture()).copied).toBe(false);
  const after = await readPicture();
  expect(after.orange).toBeGreaterThan(20);
  expect(after.blue).toBeGreaterThan(20);
});
