import type { Page } from '@playwright/test';
import { bvh } from '../support/files';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

/** A page with a take of its own. */
async function withTake(page: Page): Promise<App> {
  await page.route('**/demo/*', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
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
  for (const [index, seed] of [101, 102, 103].entries()) {
    const reloaded = page.waitForEvent('load');
    await takeMade(page, seed, 'location.reload()');
    await reloaded;
    await app.until(({ takes, restoring }, count) => takes.length === count && !restoring, index + 2);
    expect(await seeds(app)).toContain(seed);
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
  const says = (one: Page) => one.getByText('Your work is open in another tab, which keeps it.');
  await expect(says(other)).toBeVisible();
  await expect(says(page)).toBeHidden();

  // A take of the tab that keeps nothing yet is kept once it takes over, and so is what the first one has made.
  await takeMade(other, 201);
  await takeMade(page, 202);
  await other.getByRole('button', { name: 'Keep it here instead' }).click();
  await expect(says(page)).toBeVisible();
  await second.until(({ takes, autosave }) => takes.length === 3 && autosave === 'stored');
  await expect(says(other)).toBeHidden();

  // The first one keeps it again when the second is closed.
  await other.close();
  await first.until(({ takes, autosave }) => takes.length === 3 && autosave === 'stored');
  await expect(says(page)).toBeHidden();
  expect((await seeds(first)).sort()).toEqual(expect.arrayContaining([201, 202]));
});
