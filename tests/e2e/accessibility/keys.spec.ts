import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';

test('letters as shortcuts can be switched off, also for later visits; Space and Escape stay', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const letters = page.getByRole('checkbox', { name: 'Letters, digits and signs are shortcuts' });
  const loops = (): Promise<boolean> => app.read(({ playback }) => playback.loop);

  await page.keyboard.press('?');
  await letters.focus();
  await page.keyboard.press('Space');
  await page.keyboard.press('Escape');
  await expect(letters).toBeHidden();
  for (const key of ['l', '?', '3', ']']) await page.keyboard.press(key);
  expect(await loops()).toBe(false);
  expect(await app.read(({ openPanel, playback }) => [openPanel, playback.speed])).toEqual([null, 1]);
  await page.evaluate('document.activeElement.blur()');
  await page.keyboard.press('Space');
  await app.until(({ playback }) => playback.playing);

  await page.reload();
  await app.settled();
  await page.keyboard.press('Escape');
  await page.keyboard.press('l');
  expect(await loops()).toBe(false);
  await page.getByRole('button', { name: 'Keyboard shortcuts' }).click();
  await letters.check();
  await page.keyboard.press('Escape');
  await page.keyboard.press('l');
  expect(await loops()).toBe(true);
});

test('letters do nothing behind a dialog that waits for an answer', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.drop({ name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('no dance') });
  const dialog = page.getByRole('alertdialog');
  await expect(dialog).toBeVisible();
  for (const key of ['l', 'x', ']']) await page.keyboard.press(key);
  const set = () => app.read(({ playback, camera }) => [playback.loop, playback.speed, camera]);
  expect(await set()).toEqual([false, 1, 'orbit']);
  await page.keyboard.press('Escape');
  await expect(dialog).toBeHidden();
  for (const key of ['l', 'x', ']']) await page.keyboard.press(key);
  expect(await set()).toEqual([true, 1.25, 'side']);
});

test('a letter that is held acts once, an arrow goes on', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.getByRole('button', { name: 'Play the demo' }).click();
  await page.getByRole('button', { name: 'Pause' }).click();
  await page.keyboard.press('Home');
  const hold = async (key: string): Promise<void> => {
    for (let times = 0; times < 4; times++) await page.keyboard.down(key);
    await page.keyboard.up(key);
  };
  for (const key of ['l', 'n', 's']) await hold(key);
  expect(
    await app.read(({ playback, overlays, takes }) => [playback.loop, overlays.contacts, takes[0]?.starred]),
  ).toEqual([true, true, true]);
  await hold('ArrowRight');
  expect(await app.read(({ playback }) => playback.time)).toBeCloseTo(4 / 30, 5);
});

test('signs that a keyboard types with AltGr are shortcuts too', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  // As Windows reports it; with Ctrl and Alt alone it is a key of the system or of a screen reader.
  const altGr = { key: ']', ctrlKey: true, altKey: true, modifierAltGraph: true };
  await page.dispatchEvent('body', 'keydown', altGr);
  expect(await app.read(({ playback }) => playback.speed)).toBe(1.25);
  await page.dispatchEvent('body', 'keydown', { ...altGr, modifierAltGraph: false });
  expect(await app.read(({ playback }) => playback.speed)).toBe(1.25);
});

test('keys are shortcuts after a choice by mouse, and belong to a menu that was reached by keyboard', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.getByRole('button', { name: 'Play the demo' }).click();
  await page.getByRole('button', { name: 'Pause' }).click();
  const speed = page.getByRole('combobox', { name: 'Speed' });
  const playing = (): Promise<boolean> => app.read(({ playback }) => playback.playing);

  await speed.click();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Enter');
  await app.until(({ playback }) => playback.speed === 1.25);
  // They would choose 1× and 2×.
  for (const key of ['l', '1', '2']) await page.keyboard.press(key);
  expect(await app.read(({ playback }) => [playback.loop, playback.speed])).toEqual([true, 1.25]);
  await page.keyboard.press('Space');
  expect(await playing()).toBe(true);
  await page.keyboard.press('Space');
  expect(await playing()).toBe(false);

  await page.keyboard.press('Tab');
  await page.keyboard.press('Shift+Tab');
  await expect(speed).toBeFocused();
  await page.keyboard.press('Space');
  expect(await playing()).toBe(false);
  await page.keyboard.press('Escape');
  await page.keyboard.press('2');
  expect(await app.read(({ playback }) => playback.speed)).toBe(2);
});

test.describe('on a small window, where the processor draws', () => {
  test.use({ viewport: { width: 780, height: 420 } });

  test('keys turn the camera and bring it nearer', async ({ page }) => {
    const app = new App(page);
    await app.open();
    await app.settled();
    await page.getByRole('button', { name: 'Play the demo' }).click();
    await page.keyboard.press('Space');
    const shot = (): Promise<{ heading: number; distance: number }> =>
      page.evaluate('window.reactdance.stage.framing().shot');
    const before = await shot();
    for (const key of ['.', '.', 'u']) await page.keyboard.press(key);
    await expect.poll(async () => (await shot()).heading - before.heading).toBeCloseTo(Math.PI / 6, 2);
    expect((await shot()).distance / before.distance).toBeCloseTo(1 / 1.15, 2);
    for (const key of [',', ',', 'j']) await page.keyboard.press(key);
    await expect.poll(async () => (await shot()).heading - before.heading).toBeCloseTo(0, 2);
    expect((await shot()).distance / before.distance).toBeCloseTo(1, 2);
  });
});
