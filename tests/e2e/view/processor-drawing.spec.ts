import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';
import { servePage } from '../../../tools/bench/built-page.mjs';
import type { Page } from '../support/view-page/main';

/** What is drawn otherwise where there is no graphics card: it has to look the same. */
let site: Awaited<ReturnType<typeof servePage>>;

test.beforeAll(async () => {
  site = await servePage(fileURLToPath(new URL('../support/view-page', import.meta.url)), {});
});
test.afterAll(() => site.close());
test.beforeEach(({ page }) => page.goto(site.url));

for (const theme of ['dark', 'light'] as const) {
  test(`a body lit at its corners looks as one lit at every pixel, in the ${theme}`, async ({ page }) => {
    const seen = await page.evaluate<Awaited<ReturnType<Page['paints']>>>(`view.paints('${theme}')`);
    expect(seen.pixels).toBeGreaterThan(5000);
    expect(seen.mean).toBeLessThan(3);
    expect(seen.most).toBeLessThan(12);
    // Light and shade are there to be compared.
    expect(seen.contrast).toBeGreaterThan(40);
  });
}

for (const angle of [0.1, 0.6, -0.6]) {
  test(`edges turned by ${angle} are smoothed where it is asked for, and nothing else changes`, async ({
    page,
  }) => {
    const seen = await page.evaluate<ReturnType<Page['edges']>>(`view.edges(${angle})`);
    expect(seen.drawnGrey).toBe(0);
    expect(seen.leftGrey).toBeGreaterThan(200);
    expect(seen.smooth).toBeLessThan(0.9 * seen.stepped);
    expect(seen.rightGrey).toBe(0);
    expect(seen.inside).toBeGreaterThan(0.95);
    expect(seen.insideChanged).toBe(0);
  });
}
