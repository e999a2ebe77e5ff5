import type { Page } from '@playwright/test';
import { App, SHIPPED } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { type Task, tasksOf, TRACED } from '../support/main-thread';

test.use({ viewport: { width: 1280, height: 720 }, deviceScaleFactor: 1 });

/** A task of the page's own thread may take this long, milliseconds. */
const LONGEST = 100;

/** Pixels of either dancer's colour in the picture on the stage, and what kind of canvas shows it. */
const LOOK = `(() => {
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
interface Look {
  readonly orange: number;
  readonly blue: number;
  readonly copied: boolean;
  readonly picture: string;
}

/** What of a task the page computed, or waited for a picture. */
const used = ({ busy, waited }: Task): number => busy + waited.inScripts + waited.onScreen;

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

test('no task of the page is long while a reaction is made and the picture plays', async ({
  page,
  browser,
}) => {
  const app = await dancing(page);
  const before = await drawn(page);
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
  const pictures = (await drawn(page)) - before;
  expect(await app.read(({ playback }) => playback.playing)).toBe(true);
  expect(pictures).toBeGreaterThan(3);

  const longest = (of: (task: Task) => number): number => Math.round(Math.max(...tasks.map(of)));
  const long = tasks.filter(({ whole }) => whole > LONGEST);
  test.info().annotations.push({
    type: 'measured',
    description:
      `${tasks.length} tasks, ${pictures} pictures; longest: busy ${longest(({ busy }) => busy)} ms, ` +
      `from beginning to end ${longest(({ whole }) => whole)} ms, of which waiting for a picture ` +
      `${longest(({ waited }) => waited.onScreen)} ms on its way to the screen and ` +
      `${longest(({ waited }) => waited.inScripts)} ms in scripts; over ${LONGEST} ms: ` +
      (long.map((task) => `${Math.round(task.whole)} (${Math.round(used(task))})`).join(', ') || 'none'),
  });
  expect(longest(({ busy }) => busy)).toBeGreaterThan(0);
  // Where other programs run, they may take the core in the middle of a task: that is not the page's.
  expect(long.filter((task) => used(task) > LONGEST / 2)).toEqual([]);
  expect(tasks.filter((task) => used(task) > LONGEST)).toEqual([]);
});

test('while a reaction is made the dancers go on, without a graphics card as copies', async ({ page }) => {
  const app = await dancing(page);
  await page.getByRole('slider', { name: 'Coarse guidance' }).fill('1.7');
  await app.until(({ job }) => job !== null && job.fraction > 0);
  const pictures: Look[] = [];
  for (let i = 0; i < 3; i++) {
    pictures.push(await page.evaluate<Look>(LOOK));
    const before = await drawn(page);
    await expect.poll(() => drawn(page)).toBeGreaterThan(before + 2);
  }
  expect(await app.read(({ job }) => job !== null)).toBe(true);
  for (const { orange, blue, copied } of pictures) {
    expect(orange).toBeGreaterThan(20);
    expect(blue).toBeGreaterThan(20);
    expect(copied).toBe(true);
  }
  expect(new Set(pictures.map(({ picture }) => picture)).size).toBe(3);

  await app.settled();
  // A moment later the canvas itself is there again, and not empty.
  const look = () => page.evaluate<Look>(LOOK);
  await expect.poll(async () => (await look()).copied).toBe(false);
  const after = await look();
  expect(after.orange).toBeGreaterThan(20);
  expect(after.blue).toBeGreaterThan(20);
});
