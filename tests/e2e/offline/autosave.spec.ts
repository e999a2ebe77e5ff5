import type { Page } from '@playwright/test';
import type { Framing } from '../../../web/common/framing';
import { bvh } from '../support/files';
import { App, TINY } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { rested } from '../support/stage-rest';

/** A page with a take of its own. */
async function withTake(page: Page, address = TINY, name = 'mine.bvh'): Promise<App> {
  await page.route('**/demo/*', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture(address);
  await app.drop(bvh({ frames: 90, name }));
  await app.until(({ takes, job }) => takes.length === 1 && !job);
  return app;
}

/** Asks for a take with this seed and resolves in the moment in which it is there. */
async function takeMade(page: Page, seed: number, then = ''): Promise<void> {
  await page.getByRole('spinbutton', { name: 'Seed' }).fill(String(seed));
  await page.keyboard.press('Enter');
  await page.evaluate(`new Promise((resolve) => {
    const look = () => {
      const { takes } = window.reactdance.store.getState();
      if (!takes.some(({ reaction }) => reaction.inputs.settings.seed === ${seed})) return setTimeout(look, 0);
      ${then};
      resolve();
    };
    look();
  })`);
}

const seeds = (app: App): Promise<number[]> =>
  app.read(({ takes }) => takes.map(({ reaction }) => reaction.inputs.settings.seed));

test('a take is kept whose page is reloaded, or whose browser process ends, in the moment it is made', async ({
  page,
  context,
}) => {
  const app = await withTake(page);
  await page.addInitScript(() => {
    new MutationObserver(() => {
      if (document.querySelector('.first-visit:not([hidden])')) Object.assign(window, { greeted: true });
    }).observe(document, { subtree: true, childList: true, attributes: true });
  });
  for (const [index, seed] of [101, 102, 103].entries()) {
    const reloaded = page.waitForEvent('load');
    // The answer is sometimes lost with the page.
    await takeMade(page, seed, 'location.reload()').catch((error: Error) => {
      if (!error.message.includes('Execution context was destroyed')) throw error;
    });
    await reloaded;
    await app.until(({ takes, restoring }, count) => takes.length === count && !restoring, index + 2);
    expect(await seeds(app)).toContain(seed);
    expect(await page.evaluate("'greeted' in window"), 'nobody is greeted as a newcomer').toBe(false);
    await page.keyboard.press('Escape');
  }

  await takeMade(page, 104);
  const crashed = page.waitForEvent('crash');
  const session = await context.newCDPSession(page);
  session.send('Page.crash').catch(() => undefined);
  await crashed;
  const next = new App(await context.newPage());
  await next.openWithoutPicture();
  await next.until(({ takes, restoring }) => takes.length === 5 && !restoring);
  expect(await seeds(next)).toContain(104);
});

test('of two tabs one keeps the work, and the other says so and can take over', async ({ page, context }) => {
  const first = await withTake(page);
  const other = await context.newPage();
  const second = new App(other);
  await second.openWithoutPicture();
  await second.until(({ takes }) => takes.length === 1);
  const says = (one: Page) => one.getByText('Your work is open in another tab, which saves it.');
  await expect(says(other)).toBeVisible();
  await expect(says(page)).toBeHidden();

  // A take of the tab that keeps nothing yet is kept once it takes over, and so is what the first one has made.
  await takeMade(other, 201);
  await takeMade(page, 202);
  await other.getByRole('button', { name: 'Save in this tab instead' }).click();
  await expect(says(page)).toBeVisible();
  await second.until(({ takes, autosave }) => takes.length === 3 && autosave === 'stored');
  await expect(says(other)).toBeHidden();

  // The first one keeps it again when the second is closed.
  await other.close();
  await first.until(({ takes, autosave }) => takes.length === 3 && autosave === 'stored');
  await expect(says(page)).toBeHidden();
  expect((await seeds(first)).sort()).toEqual(expect.arrayContaining([201, 202]));
});

test('two copies of the page in folders of one site keep work, preferences and model apart', async ({
  page,
  context,
}) => {
  const first = await withTake(page);
  await page.keyboard.press('l');
  const other = await context.newPage();
  const second = await withTake(other, `/copy${TINY}`, 'other.bvh');
  expect(await second.read(({ playback, takes }) => [playback.loop, takes.length])).toEqual([false, 1]);
  for (const [tab, app, leader, loop] of [
    [page, first, 'mine.bvh', true],
    [other, second, 'other.bvh', false],
  ] as const) {
    await app.until(({ autosave }) => autosave === 'stored');
    await tab.reload();
    await app.until(({ takes, restoring }) => takes.length > 0 && !restoring);
    expect(
      await app.read(({ leader, playback, takes }) => [leader?.name, playback.loop, takes.length]),
    ).toEqual([leader, loop, 1]);
  }
  expect((await page.evaluate(() => caches.keys())).sort()).toEqual(
    ['model', 'runtime'].flatMap((part) => [`reactdance-${part}`, `reactdance-${part}:%2Fcopy%2F`]),
  );
});

test.describe('with a small stage, for a software renderer', () => {
  test.use({ viewport: { width: 900, height: 560 } });

  test('a reload brings back the camera, the looped part and the take on the stage', async ({ page }) => {
    await page.route('**/demo/*', (route) => route.fulfill({ status: 404 }));
    const app = new App(page);
    await app.open();
    await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
    await app.until(({ takes, job }) => takes.length === 1 && !job);
    await takeMade(page, 77);
    await page.keyboard.press('Escape');
    const takes = page.getByRole('grid', { name: 'Takes' }).getByRole('row');
    await takes.filter({ hasText: 'Take 1' }).click();
    const stage = page.locator('.picture');
    const box = (await stage.boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 90, box.y + box.height / 2 + 20, { steps: 4 });
    await page.mouse.up();
    await page.mouse.wheel(0, -240);
    await page.evaluate('document.activeElement.blur()');
    await page.keyboard.press('End');
    await page.keyboard.press('o');
    await page.keyboard.press('Home');
    for (let times = 0; times < 5; times++) await page.keyboard.press('ArrowRight');
    await page.keyboard.press('i');
    await rested(page);

    const seen = (): Promise<Framing> => page.evaluate<Framing>('window.reactdance.stage.framing()');
    const before = await seen();
    const state = () =>
      app.read(({ playback, reaction, takes }) => [
        playback.time,
        playback.region,
        takes.findIndex((take) => take.reaction === reaction),
      ]);
    const stateBefore = await state();
    expect(stateBefore[1]).not.toBeNull();
    expect(stateBefore[2]).toBe(1);
    expect(before.ownHeading && before.ownDistance).toBe(true);

    await page.reload();
    await app.until(({ takes, restoring }) => takes.length === 2 && !restoring);
    await rested(page);
    expect(await state()).toEqual(stateBefore);
    const after = await seen();
    for (const key of ['distance', 'heading', 'elevation'] as const)
      expect(after.shot[key]).toBeCloseTo(before.shot[key], 3);
    after.shot.target.forEach((value, axis) => expect(value).toBeCloseTo(before.shot.target[axis]!, 3));
    expect({ ...after, shot: null, tracked: null }).toEqual({ ...before, shot: null, tracked: null });
  });
});
