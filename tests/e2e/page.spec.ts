import { writeFileSync } from 'node:fs';
import { bvh, wav } from './support/files';
import { App } from './support/app-page';
import { expect, test } from './support/fixtures';
import { tasksOf, TRACED } from './support/main-thread';

for (const [name, width, height] of [
  ['desktop', 1440, 900],
  ['laptop', 1280, 720],
  ['phone', 390, 844],
] as const)
  test(`all main controls are visible on a ${name}`, async ({ page }) => {
    await page.setViewportSize({ width, height });
    const app = new App(page);
    await app.openWithoutPicture();
    await expect(page.getByRole('heading', { name: /Drop a video/ })).toBeInViewport({ ratio: 1 });
    // A phone has no room for the word Leader above it.
    const choose = page.getByRole('button', { name: `Choose a ${name === 'phone' ? 'dancer' : 'file'}` });
    await expect(choose).toBeInViewport({ ratio: 1 });
    await expect(page.getByRole('radio', { name: /^(Reaction|No reaction)/ }).first()).toBeInViewport({
      ratio: 0.9,
    });
    await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
    await app.reaction('mine.bvh');
    for (const control of [
      page.getByRole('button', { name: 'Play', exact: true }),
      page.getByRole('slider', { name: 'Coarse guidance' }),
      page.getByRole('slider', { name: 'Fine guidance' }),
      page.getByRole('slider', { name: 'Playhead' }),
      page.getByRole('button', { name: 'New random seed' }),
      page.getByRole('button', { name: 'Generate' }),
      page.getByRole('button', { name: 'Download', exact: true }),
      page.getByRole('button', { name: /^Leader: mine.bvh/ }),
    ])
      await expect(control).toBeInViewport({ ratio: 0.95 });
    expect(await page.evaluate<number>('document.documentElement.scrollWidth')).toBeLessThanOrEqual(width);
  });

test('the first words are whole in a low window, as when the page is twice as large', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  for (const height of [580, 561, 540, 501, 480]) {
    await page.setViewportSize({ width: 960, height });
    const stage = (await page.locator('#stage').boundingBox())!;
    const first = (await page.getByRole('heading', { name: /Drop a video/ }).boundingBox())!;
    const last = (await page.getByRole('button', { name: 'How it works' }).boundingBox())!;
    expect(first.y, String(height)).toBeGreaterThanOrEqual(stage.y);
    expect(last.y + last.height, String(height)).toBeLessThanOrEqual(stage.y + stage.height);
  }
});

test('the greatest seed is read whole in its field', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.until(({ settings }) => settings);
  const seed = page.getByRole('spinbutton', { name: 'Seed' });
  await seed.fill(String(2 ** 32 - 1));
  await page.keyboard.press('Enter');
  expect(await seed.evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)).toBe(0);
});

test('the browser can install the page', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  const session = await page.context().newCDPSession(page);
  const { errors, url } = await session.send('Page.getAppManifest');
  expect(new URL(url).pathname).toBe('/site/web-app.json');
  expect(errors).toEqual([]);
  // Tests run in a private window.
  const { installabilityErrors } = await session.send('Page.getInstallabilityErrors');
  expect(installabilityErrors.map(({ errorId }) => errorId)).toEqual(['in-incognito']);
});

test('the keys do what the list of keys says', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');

  await page.keyboard.press('?');
  await expect(page.getByRole('dialog', { name: 'Keyboard shortcuts' })).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(page.getByRole('dialog', { name: 'Keyboard shortcuts' })).toBeHidden();

  const time = () => app.read(({ playback }) => playback.time);
  await page.keyboard.press('End');
  expect(await time()).toBeCloseTo(3, 5);
  await page.keyboard.press('ArrowLeft');
  expect(await time()).toBeCloseTo(3 - 1 / 30, 5);
  // To the start of a bar; without beats a second.
  await page.keyboard.press('Shift+ArrowLeft');
  expect(await time()).toBeLessThan(3 - 2 / 30);
  await page.keyboard.press('Home');
  expect(await time()).toBe(0);

  await page.keyboard.press('c');
  await expect(page.getByRole('slider', { name: 'Coarse guidance' })).toBeFocused();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  expect(await app.read(({ settings }) => settings?.guidance['lower']?.['coarse'])).toBeCloseTo(0.1, 5);
  expect(await time()).toBe(0);
  await page.keyboard.press('r');
  expect(await app.read(({ settings }) => settings?.guidance['lower']?.['coarse'])).toBe(0);

  // Arrows and Space belong to a choice.
  await app.drop(bvh({ frames: 60, name: 'one.bvh' }), bvh({ frames: 60, name: 'two.bvh' }));
  const [one, two] = ['one.bvh', 'two.bvh'].map((name) => page.getByRole('radio', { name }));
  await expect(one!).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await expect(two!).toBeChecked();
  await page.keyboard.press('ArrowLeft');
  await expect(one!).toBeChecked();
  await page.keyboard.press('Space');
  expect(await app.read(({ playback }) => [playback.time, playback.playing])).toEqual([0, false]);
  await page.keyboard.press('Escape');

  for (const key of ['Home', 'i', 'Shift+ArrowRight', 'o']) await page.keyboard.press(key);
  const region = () => app.read(({ playback }) => playback.region);
  const looped = await region();
  expect(looped?.to).toBeLessThan(3);

  // Digits and letters typed into the seed are the seed's.
  const seed = page.getByRole('spinbutton', { name: 'Seed' });
  await seed.fill('12');
  await page.keyboard.press('Enter');
  await app.until(({ reaction }) => reaction?.inputs.settings.seed === 12);
  // Escape takes back a number that is being typed, and only then what is in the page.
  for (const box of [seed, page.getByRole('spinbutton', { name: /^Height/ })]) {
    const before = await box.inputValue();
    await box.fill('');
    await page.keyboard.type('34');
    await page.keyboard.press('Escape');
    await expect(box).toHaveValue(before);
    expect(await region()).toEqual(looped);
  }
  await page.keyboard.press('Escape');
  expect(await region()).toBeNull();
});

test('Space presses a button that the page or a key has moved the focus to, and plays after a click', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 900, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const playing = () => app.read(({ playback }) => playback.playing);
  const keys = page.getByRole('dialog', { name: 'Keyboard shortcuts' });
  await page.keyboard.press('?');
  await expect(keys.getByRole('button', { name: 'Close' })).toBeFocused();
  await page.keyboard.press('Space');
  await expect(keys).toBeHidden();
  expect(await playing()).toBe(false);

  const opener = page.getByRole('button', { name: 'Project', exact: true });
  const menu = page.getByRole('dialog', { name: 'Project' });
  await opener.click();
  await page.keyboard.press('Escape');
  await expect(opener).toBeFocused();
  await page.keyboard.press('Space');
  await expect(menu).toBeVisible();
  expect(await playing()).toBe(false);
  await menu.getByRole('button', { name: 'Close' }).click();
  await expect(opener).toBeFocused();
  await page.keyboard.press('Space');
  await expect(menu).toBeHidden();
  expect(await playing()).toBe(true);

  // A dialog that takes the place of another one keeps the focus.
  await page.keyboard.press('?');
  await page.keyboard.press('e');
  await expect(keys).toBeHidden();
  await expect(
    page.getByRole('dialog', { name: 'Download' }).getByRole('button', { name: /BVH/ }),
  ).toBeFocused();
});

test('a fader has a warm outline while its change is being applied', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 3000, name: 'long.bvh' }));
  await app.reaction('long.bvh');
  const applying = page.locator('.fader.applying');
  await expect(applying).toHaveCount(0);
  await page.getByRole('slider', { name: 'Fine guidance' }).fill('1');
  await expect(applying).toHaveCount(1);
  await expect(applying).toContainText('Fine');
  await app.until(({ job }) => !job);
  await expect(applying).toHaveCount(0);
});

test('the playhead follows the pointer', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 300, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const box = await page.getByRole('img', { name: /^Leader speed/ }).boundingBox();
  if (!box) throw new Error('The leader is not on the page.');
  await page.mouse.move(box.x + box.width / 4, box.y + 10);
  await page.mouse.down();
  expect(await app.read(({ playback }) => playback.time)).toBeCloseTo(2.5, 1);
  await page.mouse.move(box.x + box.width / 2, box.y + 10);
  await page.mouse.up();
  await page.mouse.move(box.x, box.y + 10);
  expect(await app.read(({ playback }) => playback.time)).toBeCloseTo(5, 1);
});

test('the theme follows the system until it is chosen, and is then kept', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'light' });
  const app = new App(page);
  await app.openWithoutPicture();
  const theme = () => page.locator('html').getAttribute('data-theme');
  expect(await theme()).toBe('light');
  await page.emulateMedia({ colorScheme: 'dark' });
  await expect.poll(theme).toBe('dark');
  await page.getByRole('button', { name: 'Switch to light' }).click();
  expect(await theme()).toBe('light');
  await page.reload();
  expect(await theme()).toBe('light');
});

test('a song of three minutes is read while the page stays responsive', async ({ page, browser }) => {
  const app = new App(page);
  const { name, buffer } = wav({ seconds: 180, name: 'long song.wav' });
  const path = test.info().outputPath(name);
  writeFileSync(path, buffer);
  await app.openWithoutPicture();
  await app.settled();
  await browser.startTracing(page, { categories: TRACED });
  await page.evaluate(`
    window.parts = new Set();
    performance.mark('asked');
    (function check() {
      const { reading, song } = window.reactdance.store.getState();
      if (reading.song) window.parts.add(reading.song.fraction);
      if (song?.name === 'long song.wav') performance.mark('read');
      else setTimeout(check, 20);
    })();
  `);
  await app.chooseSong(path);
  await app.until(() => performance.getEntriesByName('read').length);
  const tasks = tasksOf(await browser.stopTracing(), 'asked', 'read');
  const busy = tasks.map((task) => Math.round(task.busy)).toSorted((a, b) => b - a);
  test.info().annotations.push({
    type: 'measured',
    description: `longest tasks, processor time: ${busy.slice(0, 5).join(', ')} ms`,
  });

  const parts = await page.evaluate<number[]>('[...window.parts]');
  expect(parts.length).toBeGreaterThan(3);
  expect(parts).toEqual(parts.toSorted((a, b) => a - b));
  // Reading itself asks little of the page's own thread, however busy other programs keep the machine.
  expect(busy[0]).toBeGreaterThan(0);
  expect(busy[0]).toBeLessThanOrEqual(100);
});

test('the page links to the licences of all its software', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  const opening = page.waitForEvent('popup');
  await page.getByRole('link', { name: 'Licences' }).click();
  await expect((await opening).getByText('Fabian Hiller').first()).toBeVisible();
});

for (const [where, without, sentence] of [
  ['in a browser of 2023', 'delete AbortSignal.any', 'This browser is too old'],
  ['where Lockdown Mode is on', 'delete globalThis.WebAssembly', 'WebAssembly, in which this page computes,'],
] as const)
  test(`${where}, a sentence stands in the place of the page`, async ({ page }) => {
    await page.addInitScript(without);
    await page.goto('/');
    await expect(page.getByRole('alert')).toContainText(sentence);
    await expect(page.locator('.app')).not.toBeAttached();
  });
