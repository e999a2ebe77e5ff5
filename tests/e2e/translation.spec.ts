/** The page while the browser translates it, as Chrome, Edge and Firefox offer to visitors with another language. */
import type { Page } from '@playwright/test';
import { App } from './support/app-page';
import { bvh } from './support/files';
import { expect, test } from './support/fixtures';

/**
 * Puts longer words in the place of all that the page says, now and whenever it says something else, inside of new
 * elements, as translators do. Names for screen readers and tooltips are translated as well.
 */
async function translate(page: Page): Promise<void> {
  await page.evaluate(() => {
    const isKept = (element: Element | null): boolean =>
      element === null || element.closest('[translate=no], font, script, style') !== null;
    const longer = (text: string): string => (/[a-z]/i.test(text) ? `${text} · ${text.slice(0, 8)}` : text);
    const translateText = (node: Text): void => {
      if (isKept(node.parentElement) || !node.data.trim()) return;
      const font = document.createElement('font');
      font.append(longer(node.data));
      // An option holds nothing but text.
      if (node.parentElement?.tagName !== 'OPTION') node.replaceWith(font);
    };
    const translateNames = (element: Element): void => {
      for (const name of ['aria-label', 'title']) {
        const text = element.getAttribute(name) ?? '';
        if (/[a-z]/i.test(text) && !text.includes(' · ') && !isKept(element))
          element.setAttribute(name, longer(text));
      }
    };
    const translateAll = (root: Node): void => {
      if (root instanceof Text) translateText(root);
      if (!(root instanceof Element)) return;
      const texts: Text[] = [];
      const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
      while (walker.nextNode()) texts.push(walker.currentNode as Text);
      texts.forEach(translateText);
      [root, ...root.querySelectorAll('[aria-label], [title]')].forEach(translateNames);
    };
    translateAll(document.body);
    new MutationObserver((changes) => {
      for (const { addedNodes, target, type } of changes) {
        addedNodes.forEach(translateAll);
        if (type === 'attributes' && target instanceof Element) translateNames(target);
      }
    }).observe(document.body, {
      childList: true,
      subtree: true,
      attributes: true,
      attributeFilter: ['aria-label', 'title'],
    });
  });
}

test('under a translation, names stay as they are, keys find their faders and nothing is cut off', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await translate(page);
  await app.drop(bvh({ frames: 60, name: 'Slow turn.bvh' }));
  await app.reaction('Slow turn.bvh');
  await expect(page.getByRole('heading', { name: 'Guidance', exact: true })).toHaveCount(0);
  await expect(page.locator('.chip b').nth(1)).toHaveText('Slow turn.bvh');

  await test.step('a take keeps its name when the field for it is left', async () => {
    const row = page.locator('.take').first();
    const field = row.locator('input');
    await row.press('F2');
    await field.fill('Soft hands');
    await field.press('Enter');
    await expect(row.locator('b')).toHaveText('Soft hands');
    await row.press('F2');
    await expect(field).toHaveValue('Soft hands');
    await page.locator('.panel h2').first().click();
    expect(await app.read(({ takes }) => takes[0]?.name)).toBe('Soft hands');
    await expect(row.locator('.letters')).toHaveText('AB');
  });

  await test.step('a letter leads to its fader', async () => {
    await page.evaluate('document.activeElement.blur()');
    await page.keyboard.press('v');
    await page.keyboard.press('ArrowRight');
    await app.until(({ settings }) => settings?.guidance['lower']?.['fine'] === 0.05);
  });

  await test.step('the list of keys has the keys', async () => {
    await page.keyboard.press('?');
    const keys = await page.locator('.keys kbd').allTextContents();
    expect(keys).toContain('I');
    expect(keys.filter((key) => key.includes(' · '))).toEqual([]);
    await page.keyboard.press('Escape');
  });

  await test.step('all sizes of the video and all buttons are inside their panels', async () => {
    await page.keyboard.press('e');
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>('.menu .btn, .options .btn')]
        .filter((button) => button.checkVisibility())
        .filter((button) => {
          const panel = button.closest('.menu, .panel')!.getBoundingClientRect();
          return button.getBoundingClientRect().right > panel.right;
        })
        .map(({ textContent }) => textContent),
    );
    expect(cut).toEqual([]);
  });
});

test('turned round for a language that is written from right to left, the timeline stays as it is', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.keyboard.press('End');
  const places = (): Promise<number[]> =>
    page.evaluate(() =>
      ['.head-line', '.panel', '.switch .knob', '.fader .fill'].map((selector) =>
        Math.round(document.querySelector(selector)!.getBoundingClientRect().left),
      ),
    );
  const before = await places();
  await page.evaluate(() => (document.documentElement.dir = 'rtl'));
  expect(await places()).toEqual(before);
  const fader = page.getByRole('slider', { name: 'Coarse guidance' });
  await fader.press('ArrowRight');
  expect(Number(await fader.inputValue())).toBeGreaterThan(0);
});
