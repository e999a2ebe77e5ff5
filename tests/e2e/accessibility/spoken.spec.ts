import { readFileSync } from 'node:fs';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

test('screen readers hear a fader once, and no playhead over the music', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.getByRole('button', { name: 'Play the demo' }).click();
  await page.keyboard.press('Space');

  await test.step('the fader that is moved says its value, nothing else does', async () => {
    const loud = page.locator('output:not([aria-live="off"])');
    await expect(loud).toHaveCount(0);
    const fader = page.getByRole('slider', { name: 'Coarse guidance' });
    await fader.focus();
    await page.keyboard.press('ArrowRight');
    await expect(fader).toHaveAttribute('aria-valuetext', '0.05, a little towards larger');
    await app.settled();
  });

  await test.step('while it plays the playhead that has the focus keeps its words', async () => {
    const playhead = page.getByRole('slider', { name: 'Playhead' });
    await playhead.focus();
    await page.keyboard.press('Home');
    await expect(playhead).toHaveAttribute('aria-valuetext', /^0\.0 seconds/);
    await page.keyboard.press('Space');
    await app.until(({ playback }) => playback.time > 0.5);
    await expect(playhead).toHaveAttribute('aria-valuetext', /^0\.0 seconds/);
    await page.keyboard.press('Space');
    await expect(playhead).not.toHaveAttribute('aria-valuetext', /^0\.0 seconds/);
  });
});

test('screen readers hear a toast again where it says the same again', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const download = page.waitForEvent('download');
  await page.keyboard.press('Control+s');
  const project = await (await download).path();
  const spoken = page.locator('.stage p[role="status"]', { hasText: 'Opened:' });
  const open = async (): Promise<void> => {
    await page.locator('#choose-project').setInputFiles({
      name: 'dance.reactdance',
      mimeType: '',
      buffer: readFileSync(project),
    });
  };
  await open();
  await expect(spoken).toHaveCount(1);
  await spoken.evaluate((element) => {
    const seen = new MutationObserver(() => element.setAttribute('data-again', ''));
    seen.observe(element, { childList: true, characterData: true, subtree: true });
  });
  await open();
  await expect(spoken).toHaveAttribute('data-again', '');
});
