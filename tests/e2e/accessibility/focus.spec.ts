import type { Page } from '@playwright/test';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

/** The page with the demo, and how its buttons are pressed by key. */
async function byKeyboard(page: Page): Promise<{ app: App; press: (name: string) => Promise<void> }> {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  return {
    app,
    press: async (name) => {
      await page.getByRole('button', { name, exact: true }).focus();
      await page.keyboard.press('Enter');
    },
  };
}

test('a button that is disabled by its own press keeps the focus and does nothing until it is enabled', async ({
  page,
}) => {
  const { app, press } = await byKeyboard(page);
  await press('Play the demo');
  await expect(page.getByRole('button', { name: 'Pause' }), 'the first-visit block has gone').toBeFocused();
  await page.keyboard.press('Enter');

  await test.step('zoom of the timeline', async () => {
    const zoomIn = page.getByRole('button', { name: 'Zoom in' });
    await zoomIn.focus();
    for (let times = 0; times < 8; times++) await page.keyboard.press('Enter');
    await expect(zoomIn).toBeDisabled();
    await expect(zoomIn).toBeFocused();
    await press('Show the whole dance');
    await expect(page.getByRole('button', { name: 'Show the whole dance' })).toBeFocused();
    // Disabled, enabled and disabled again while it has the focus.
    await page.keyboard.press('+');
    await page.keyboard.press('Enter');
    await expect(page.getByRole('button', { name: 'Show the whole dance' })).toBeDisabled();
    await page.keyboard.press('Tab');
    await expect(page.getByRole('button', { name: 'Show the whole dance' })).toHaveJSProperty(
      'disabled',
      true,
    );
  });

  await test.step('another reaction', async () => {
    const generate = page.getByRole('button', { name: 'Generate again' });
    await press('Generate again');
    await expect(generate).toBeFocused();
    await page.keyboard.press('Enter');
    await app.settled();
    expect(await app.read(({ takes }) => takes.length), 'the second press made none').toBe(2);
    await expect(generate).toBeEnabled();
    await expect(generate).toBeFocused();
  });

  await test.step('undo', async () => {
    const undo = page.getByRole('button', { name: 'Undo' }).first();
    await undo.focus();
    while (await undo.isEnabled()) await page.keyboard.press('Enter');
    await expect(undo).toBeFocused();
  });

  await test.step('the count as found', async () => {
    await page.getByRole('button', { name: /^Bar/ }).focus();
    await page.keyboard.press('Enter');
    await press('At the playhead');
    await press('Count as found');
    await expect(page.getByRole('button', { name: 'Count as found' })).toBeFocused();
    await page.keyboard.press('Escape');
    await expect(page.getByRole('button', { name: /^Bar/ })).toBeFocused();
  });
});

test('what goes while it has the focus hands it to what is beside it', async ({ page }) => {
  const { app, press } = await byKeyboard(page);
  await press('Play the demo');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Home');

  await test.step('a handle of the loop', async () => {
    await page.keyboard.press('i');
    await page.keyboard.press('End');
    await page.keyboard.press('o');
    const end = page.getByRole('slider', { name: 'Loop end' });
    await expect(end, 'it is no part of another slider').toHaveAttribute('aria-valuetext', /^0:0\d/);
    expect(await end.evaluate((handle) => handle.parentElement?.closest('[role="slider"]'))).toBeNull();
    await end.focus();
    await page.keyboard.press('Escape');
    await expect(page.getByRole('slider', { name: 'Playhead' })).toBeFocused();
  });

  await test.step('the button that moves the song back', async () => {
    const grip = page.getByRole('slider', { name: 'Song shift' });
    await grip.focus();
    await page.keyboard.press('ArrowRight');
    await page.getByRole('button', { name: /^Song shift .*move it back/ }).focus();
    await page.keyboard.press('Enter');
    await expect(grip).toBeFocused();
    await app.settled();
  });

  await test.step('the last of the takes', async () => {
    const rows = page.getByRole('grid', { name: 'Takes' }).getByRole('row');
    await rows.first().focus();
    for (let left = await rows.count(); left > 0; left--) await page.keyboard.press('Delete');
    await expect(rows).toHaveCount(0);
    await expect(page.getByRole('heading', { name: 'Takes' })).toBeFocused();
  });
});
