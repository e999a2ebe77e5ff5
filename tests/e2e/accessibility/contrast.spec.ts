import type { Locator } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

test('a high contrast palette of the system shows playhead, switches and buttons', async ({ page }) => {
  await page.emulateMedia({ forcedColors: 'active', colorScheme: 'dark' });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const drawn = await page.evaluate(() => {
    const text = getComputedStyle(document.body).color;
    return (
      [
        ['.head-line', '::after'],
        ['.switch .knob', '::before'],
        ['.play', undefined],
      ] as const
    ).map(([selector, part]) => {
      const element = document.querySelector(selector);
      return element && getComputedStyle(element, part).backgroundColor === text;
    });
  });
  expect(drawn).toEqual([true, true, true]);
});

test('a high contrast palette shows the focus on whatever has it, and which dancer is which', async ({
  page,
}) => {
  await page.emulateMedia({ forcedColors: 'active', colorScheme: 'dark' });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.until(({ quality }) => quality);
  await page.keyboard.press('Space');
  await page.keyboard.press('Space');
  const colour = (of: Locator, property: string): Promise<string> =>
    of.evaluate((element, name) => getComputedStyle(element).getPropertyValue(name), property);
  const words = await colour(page.locator('body'), 'color');

  for (const focused of [
    page.getByRole('radio', { name: 'Orbit' }),
    page.getByRole('grid', { name: 'Takes' }).getByRole('row').first(),
    page.locator('.flag:visible').first(),
  ]) {
    await focused.focus();
    await page.keyboard.press('Shift');
    await expect(focused).toHaveCSS('outline-style', 'solid');
    await expect(focused).toHaveCSS('outline-color', words);
  }
  const [leader, reactor] = await Promise.all(
    ['leader', 'reactor'].map((role) => colour(page.locator(`.legend .${role} .dot`), 'background-color')),
  );
  expect(new Set([leader, reactor, words]).size).toBe(3);
});

test('at 400 % all of the download menu is in the window, and keys still move song and loop', async ({
  page,
}) => {
  await page.setViewportSize({ width: 320, height: 256 });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.keyboard.press('e');
  const menu = page.getByRole('dialog', { name: 'Download' });
  await expect(menu).toBeVisible();
  expect(await menu.evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)).toBe(0);

  await page.keyboard.press('Escape');
  for (const [key, name] of [
    ['Home', 'Song shift'],
    ['i', 'Loop start'],
  ] as const) {
    await page.evaluate('document.activeElement.blur()');
    await page.keyboard.press(key);
    const slider = page.getByRole('slider', { name });
    await slider.focus();
    await page.keyboard.press('ArrowRight');
    await expect(slider).toBeFocused();
  }
  expect(await app.read(({ shift }) => shift)).toBe(1);
  expect(await app.read(({ playback }) => playback.region?.from)).toBeGreaterThan(0);
});
