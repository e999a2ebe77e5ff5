import type { Page } from '@playwright/test';
import { bvh } from '../support/files';
import { App, maxDistance } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { rested } from '../support/stage-rest';

/** Joints of the ghost as drawn, 22 x 3 metres; zeros without one. */
const ghost = (page: Page): Promise<number[]> =>
  page.evaluate("Array.from(window.reactdance.stage.jointPositions('earlier'))");
const gone = (joints: readonly number[]): boolean => joints.every((value) => value === 0);

test('the dance before a change stays as a ghost for two seconds, and that of before a drag while it lasts', async ({
  page,
}) => {
  await page.setViewportSize({ width: 900, height: 640 });
  const app = new App(page);
  await app.open();
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  for (let second = 0; second < 2; second++) await page.keyboard.press('Shift+ArrowRight');
  await page.evaluate('window.reactdance.stage.ready()');
  await rested(page);
  const legend = page.getByRole('listitem').filter({ hasText: 'Before' });
  await expect(legend).toBeHidden();

  const before = await app.onScreen();
  const coarse = page.getByRole('slider', { name: 'Coarse guidance' });
  // Watched in the page, as a test beside others may look seldom.
  const watched = page.evaluate<{
    seconds: number;
    joints: number[];
    named: boolean;
  }>(`new Promise((resolve) => {
    const { store, stage } = window.reactdance;
    let first = null;
    (function look() {
      const joints = Array.from(stage.jointPositions('earlier'));
      const isDrawn = joints.some((value) => value !== 0);
      const named = [...document.querySelectorAll('[role=listitem], li')].some(
        (item) => item.textContent.includes('Before') && item.checkVisibility(),
      );
      if (isDrawn && !first) first = { since: performance.now(), joints, named };
      else if (first && !isDrawn && !store.getState().earlier)
        return resolve({ ...first, seconds: (performance.now() - first.since) / 1000 });
      requestAnimationFrame(look);
    })();
  })`);
  await coarse.fill('0.6');
  const seen = await watched;
  // The hands turn to the leader's, so wrists are not compared.
  expect(maxDistance(before.slice(0, 60), seen.joints.slice(0, 60))).toBeLessThan(1e-4);
  expect(seen.named).toBe(true);
  expect(seen.seconds).toBeGreaterThan(1.5);
  await expect(legend).toBeHidden();
  await rested(page);

  const start = await app.onScreen();
  expect(maxDistance(before, start)).toBeGreaterThan(1e-3);
  const box = (await coarse.boundingBox())!;
  const at = (share: number) => [box.x + box.width * share, box.y + box.height / 2] as const;
  const settingsOf = () => app.read(({ earlier }) => earlier?.inputs.settings.guidance['upper']?.['coarse']);
  await page.mouse.move(...at(0.75));
  await page.mouse.down();
  for (const share of [0.5, 0.3, 0.15]) {
    await page.mouse.move(...at(share));
    await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
    expect(await settingsOf()).toBe(0.6);
  }
  expect(maxDistance(start.slice(0, 60), (await ghost(page)).slice(0, 60))).toBeLessThan(1e-4);
  await page.mouse.up();
  await app.until(({ earlier }) => !earlier);

  // With reduced motion it goes at once.
  await rested(page);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await coarse.fill('0');
  await app.until(({ earlier }) => earlier);
  expect(gone(await ghost(page))).toBe(false);
  await page.evaluate(`new Promise((resolve) => {
    const { store, stage } = window.reactdance;
    (function check() {
      if (store.getState().earlier) setTimeout(check, 1);
      else resolve();
    })();
  })`);
  expect(gone(await ghost(page))).toBe(true);

  await test.step('the ghost of a compared take is named by its letter', async () => {
    const named = (name: string) => page.getByRole('listitem').filter({ hasText: name });
    await page
      .getByRole('button', { name: /^Use .* as B$/, disabled: false })
      .last()
      .click();
    await expect(named('Take B')).toBeHidden();
    await page.getByRole('button', { name: 'Ghost', exact: true }).click();
    await expect(named('Take B')).toBeVisible();
    await page.keyboard.press('b');
    await expect(named('Take A')).toBeVisible();
    await expect(named('Take B')).toBeHidden();
  });
});
