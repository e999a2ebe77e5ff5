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
  await coarse.fill('0.6');
  await app.until(({ earlier }) => earlier);
  await expect(legend).toBeVisible();
  // The hands turn to the leader's, so wrists are not compared.
  expect(maxDistance(before.slice(0, 60), (await ghost(page)).slice(0, 60))).toBeLessThan(1e-4);
  const seen = await page.evaluate<number>(`new Promise((resolve) => {
    const shownAt = performance.now();
    (function check() {
      const { store, stage } = window.reactdance;
      if (!store.getState().earlier && stage.jointPositions('earlier').every((value) => value === 0))
        resolve((performance.now() - shownAt) / 1000);
      else requestAnimationFrame(check);
    })();
  })`);
  expect(seen).toBeGreaterThan(1.5);
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
});
