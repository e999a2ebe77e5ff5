import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

/**
 * What axe finds against WCAG 2.2 AA and its own best practices: everything in the dark theme, from which the light one
 * differs in its colours alone.
 */
async function violations(page: Page, theme: 'dark' | 'light'): Promise<string[]> {
  const axe = new AxeBuilder({ page });
  const { violations: found } = await (
    theme === 'light' ? axe.withRules(['color-contrast', 'link-in-text-block']) : axe
  ).analyze();
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 160)).join(' | ')}`);
}

for (const theme of ['dark', 'light'] as const) {
  test(`axe finds no accessibility violation, ${theme}`, async ({ page }) => {
    await page.emulateMedia({ colorScheme: theme, reducedMotion: 'reduce' });
    const app = new App(page);
    await app.openWithoutPicture();
    await app.settled();
    expect(await violations(page, theme), 'first visit').toEqual([]);

    await page.keyboard.press('Space');
    await page.keyboard.press('Space');
    expect(await violations(page, theme), 'the demo on the stage').toEqual([]);

    await page.getByRole('button', { name: 'By body part' }).click();
    expect(await violations(page, theme), 'guidance by body part').toEqual([]);
    await page.getByRole('button', { name: 'By body part' }).click();

    for (const [key, what] of [
      ['e', 'download'],
      ['?', 'keys'],
    ] as const) {
      await page.keyboard.press(key);
      expect(await violations(page, theme), what).toEqual([]);
      await page.keyboard.press('Escape');
    }

    await page.setViewportSize({ width: 390, height: 844 });
    expect(await violations(page, theme), 'on a phone').toEqual([]);
  });
}

test('whoever has set a larger text in the browser gets the page larger as a whole', async ({
  page,
  playwright,
  launchOptions,
  site,
}) => {
  const boxes = async (opened: Page): Promise<Map<string, readonly number[]>> => {
    const app = new App(opened);
    await app.openWithoutPicture();
    await app.settled();
    // The worst moments are buttons, too.
    await app.until(({ quality }) => quality);
    const rows = await opened.evaluate(() =>
      [...document.querySelectorAll('button, h1, h2, .lane-label, .panel')]
        .map((element) => ({ name: element.textContent, box: element.getBoundingClientRect() }))
        .filter(({ box }) => box.width > 0)
        .map(({ name, box }, index) => [`${index} ${name}`, [box.x, box.y, box.width, box.height]] as const),
    );
    return new Map<string, readonly number[]>(rows);
  };
  const usual = await boxes(page);
  const browser = await playwright.chromium.launch({
    ...launchOptions,
    args: [...(launchOptions.args ?? []), '--blink-settings=defaultFontSize=20'],
  });
  try {
    const viewport = { width: 1.25 * 1280, height: 1.25 * 800 };
    const larger = await boxes(await browser.newPage({ baseURL: site, viewport, serviceWorkers: 'block' }));
    expect([...larger.keys()]).toEqual([...usual.keys()]);
    expect(usual.size).toBeGreaterThan(30);
    // Letters are as wide as the system's hinting makes them at each size.
    const off = [...usual].filter(([name, box]) =>
      box.some((value, side) => Math.abs(1.25 * value - larger.get(name)![side]!) > 8),
    );
    expect(off.map(([name, box]) => [name, box, larger.get(name)])).toEqual([]);
  } finally {
    await browser.close();
  }
});
