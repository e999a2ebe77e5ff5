import { bvh, wav } from './support/files';
import { App, maxDistance } from './support/app-page';
import { expect, test } from './support/fixtures';

test('guidance by body part, presets and reset', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const coarse = page.getByRole('slider', { name: 'Coarse guidance' });
  const upper = page.getByRole('slider', { name: 'Upper body, coarse' });
  const lower = page.getByRole('slider', { name: 'Lower body, coarse' });
  const preset = page.getByRole('combobox', { name: 'Guidance preset' });
  const fold = page.getByRole('button', { name: /By body part/ });
  await preset.selectOption({ index: 0 });

  await expect(upper).toBeHidden();
  await fold.click();
  await expect(fold).toContainText('Same for all');
  await upper.fill('1.5');
  await expect(fold).toContainText('Mixed');
  await expect(coarse).toHaveAttribute('aria-valuetext', /0\.50.*mixed/);
  await expect(preset.locator('option:checked')).toHaveText('Custom');

  // The big fader moves the parts together; the small ones have its keys.
  await coarse.fill('1.5');
  await expect(upper).toHaveValue('2.5');
  await expect(lower).toHaveValue('1');
  await lower.focus();
  await page.keyboard.press('ArrowRight');
  await expect(lower).toHaveValue('1.05');
  await upper.dblclick();
  await expect(upper).toHaveValue('0');

  await preset.selectOption({ label: "Paper's choice  (1.2, 1.2)" });
  await expect(upper).toHaveValue('1.2');
  await expect(preset.locator('option:checked')).toHaveText(/^Paper's choice/);
  await expect(fold).toContainText('Same for all');
  await page.getByRole('button', { name: 'Reset guidance' }).click();
  await expect(preset.locator('option:checked')).toHaveText(/^Balanced/);
});

test('the music has its own guidance, which is disabled without a song', async ({ page }) => {
  await page.route('**/demo/demo.json', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const music = page.getByRole('slider', { name: 'Music guidance' });
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  await expect(music).toBeDisabled();

  await app.drop(wav({ seconds: 3 }));
  await expect(music).toBeEnabled();
  const made = (value: number) =>
    app.until(
      ({ reaction, job }, m) => !job && reaction?.inputs.song && reaction.inputs.settings.music === m,
      value,
    );
  await made(1);
  const before = await app.reactor();
  await page.keyboard.press('m');
  await expect(music).toBeFocused();
  await page.keyboard.press('End');
  await made(4);
  expect(maxDistance(before, await app.reactor())).toBeGreaterThan(1e-3);
  await expect(music).toHaveAttribute('aria-valuetext', '4.00, the song is heard strongly');

  // Eq. 9 of the paper knows nothing of it; the model's own preset does.
  const preset = page.getByRole('combobox', { name: 'Guidance preset' });
  await preset.selectOption({ label: "Paper's choice  (1.2, 1.2)" });
  await made(0);
  await preset.selectOption({ index: 0 });
  await made(1);
  expect(maxDistance(before, await app.reactor())).toBeLessThan(1e-6);
  await music.dblclick();
  await expect(music).toHaveValue('1');
});

test('the seed is chosen at random, locked and kept, and swapped roles are named everywhere', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const again = page.getByRole('button', { name: 'Generate again' });
  const dice = page.getByRole('button', { name: 'Roll a new seed' });
  const lock = page.getByRole('button', { name: 'Lock the seed' });
  const made = () => app.read(({ reaction }) => reaction?.inputs.settings.seed ?? null);
  const done = () =>
    app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);

  const first = await made();
  await again.click();
  await app.until(({ reaction }, seed) => reaction && reaction.inputs.settings.seed !== seed, first);
  await done();
  const second = await made();
  await lock.click();
  await expect(lock).toHaveAttribute('aria-pressed', 'true');
  await expect(dice).toBeDisabled();
  await page.keyboard.press('d');
  const before = await app.read(({ reaction }) => reaction?.motion.positions[0]);
  await again.click();
  await done();
  expect(await made()).toBe(second);
  expect(await app.read(({ reaction }) => reaction?.motion.positions[0])).toBe(before);

  const reactor = await app.reactor();
  await page.getByRole('button', { name: 'Swap roles' }).click();
  await app.until(({ job, reaction }) => !job && reaction?.inputs.settings.role === 'leader');
  expect(maxDistance(reactor, await app.reactor())).toBeGreaterThan(1e-3);
  await expect(page.getByRole('button', { name: /^Reactor: mine\.bvh/ })).toBeVisible();
  // The letter of the take on the stage has the colour of the dancer that it made.
  const letter = page.getByRole('button', { name: /^Use .* as A$/, pressed: true });
  const leader = await page
    .getByRole('listitem')
    .filter({ hasText: 'Leader' })
    .evaluate((item) => getComputedStyle(item).color);
  await expect(letter).toHaveCSS('background-color', leader);
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  const menu = page.getByRole('dialog', { name: 'Download' });
  await expect(menu.getByRole('radio', { name: 'Leader' })).toBeChecked();
  await expect(menu).toContainText(/_leader\.bvh/);
});

test('three reactions are made one after the other, to pick from', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 900, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const seed = (await app.read(({ settings }) => settings?.seed)) ?? 0;
  const cards = page.getByRole('radiogroup', { name: 'Reactions to pick from' }).getByRole('radio');
  await expect(cards.first()).toBeChecked();
  await expect(cards.last()).toBeDisabled();

  const three = page.getByRole('button', { name: 'Three reactions' });
  await three.click();
  await page.keyboard.press('Escape');
  await app.until(({ variations }) => variations && !variations.making);
  await expect(cards.last()).toBeDisabled();
  await three.click();
  await app.until(({ variations }) => variations?.list.every(({ reaction }) => reaction));
  await expect(cards).toHaveCount(3);
  const before = await app.reactor();
  await cards.nth(2).click();
  await expect(cards.nth(2)).toBeChecked();
  expect(await app.read(({ settings, job }) => [settings?.seed, job])).toEqual([seed + 2, null]);
  expect(maxDistance(before, await app.reactor())).toBeGreaterThan(1e-3);
  await page.keyboard.press('ArrowRight');
  await expect(cards.first()).toBeChecked();
  expect(maxDistance(before, await app.reactor())).toBe(0);
  // Each card holds a picture of its own.
  const drawn = await cards
    .locator('canvas')
    .evaluateAll((list) => list.map((canvas) => (canvas as HTMLCanvasElement).toDataURL()));
  expect(new Set(drawn).size).toBe(3);

  // Other guidance asks for other reactions.
  await page.getByRole('slider', { name: 'Coarse guidance' }).fill('2');
  await expect(cards.last()).toBeDisabled();
  await app.until(({ job, variations }) => !job && !variations);
});
