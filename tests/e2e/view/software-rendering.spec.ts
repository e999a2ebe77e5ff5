import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';
import { servePage } from '../../../tools/bench/built-page.mjs';
import type { Page } from '../support/view-page/main';

/** What a software renderer draws in another way than a graphics card has to look the same. */
let site: Awaited<ReturnType<typeof servePage>>;

test.beforeAll(async () => {
  site = await servePage(fileURLToPath(new URL('../support/view-page', import.meta.url)), {});
});
test.afterAll(() => site.close());
test.beforeEach(({ page }) => page.goto(site.url));

for (const theme of ['dark', 'light'] as const) {
  test(`lighting per vertex looks like lighting per pixel, in the ${theme} theme`, async ({ page }) => {
    const result = await page.evaluate<Awaited<ReturnType<Page['materials']>>>(`view.materials('${theme}')`);
    expect(result.pixels).toBeGreaterThan(5000);
    expect(result.mean).toBeLessThan(3);
    expect(result.most).toBeLessThan(12);
    // The body has light and shade to compare.
    expect(result.contrast).toBeGreaterThan(40);
  });
}

for (const angle of [0.1, 0.6, -0.6]) {
  test(`edges turned by ${angle} radians are smoothed in the given rectangle, and nothing else changes`, async ({
    page,
  }) => {
    const result = await page.evaluate<ReturnType<Page['edges']>>(`view.edges(${angle})`);
    expect(result.drawnGrey).toBe(0);
    expect(result.leftGrey).toBeGreaterThan(200);
    expect(result.smooth).toBeLessThan(0.9 * result.stepped);
    expect(result.rightGrey).toBe(0);
    expect(result.inside).toBeGreaterThan(0.95);
    expect(result.insideChanged).toBe(0);
  });
}
