import { readFileSync } from 'node:fs';
import { leaderBvh } from '../web/support/leader-bvh';
import { bvh, bvhText } from './support/files';
import { App, maxDistance, meanSpeed, SHIPPED } from './support/app-page';
import { expect, test } from './support/fixtures';
import { demoSettings, serveDemo } from './support/made-demo';

test.use({ shippedDemo: true });

test('the shipped demo plays a duet on one click', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture(SHIPPED);
  await app.until(({ demo, reading }) => demo !== 'loading' && !reading.song);
  await expect(page.getByRole('button', { name: /^Song: .*demo/ })).toBeVisible();
  await expect(page.getByRole('button', { name: /^Leader: .*demo/ })).toBeVisible();
  // The poster's 12.4 s are in the 33rd beat of 164 BPM from the "1" that demo.json gives.
  await expect(page.getByRole('button', { name: /^Bar .* Count/ })).toHaveText(/Bar\s*9\s*Count\s*1/);
  await page.getByRole('button', { name: 'Play the demo' }).click();
  await app.until(({ playback }) => playback.playing && playback.time > 0.5);
  await expect(page.getByRole('heading', { name: /Drop a video/ })).toBeHidden();
  await app.until(({ reaction, song }) => reaction && song);
  expect(meanSpeed(await app.reactor())).toBeGreaterThan(0.02);
  // Back to the start while it plays, and on from there.
  await app.until(({ playback }) => playback.time > 2);
  await page.keyboard.press('Home');
  await app.until(({ playback }) => playback.playing && playback.time > 0.1 && playback.time < 1.5);
});

test('the model is not downloaded before the demo, which a slow connection would bring late', async ({
  page,
  requests,
}) => {
  const app = new App(page);
  let send = (): void => undefined;
  const held = new Promise<void>((resolve) => (send = resolve));
  await serveDemo(page, demoSettings);
  await page.route('**/demo/song.wav', async (route) => {
    await held;
    await route.fallback();
  });
  await app.openWithoutPicture();
  await app.until(({ reaction, manifest }) => reaction && manifest);
  const large = (): string[] => requests.filter((address) => /\.(onnx|wasm)$/.test(address));
  expect(large()).toEqual([]);
  send();
  await app.until(({ model }) => model.phase === 'ready');
  expect(large()).toHaveLength(4);
});

test('the foot lock is switched by key, and stage and file follow at once', async ({ page }) => {
  const app = new App(page);
  await app.open(SHIPPED);
  await app.settled();
  const lock = page.getByRole('switch', { name: 'Foot lock' });
  await expect(lock).toBeChecked();
  await expect(lock).toHaveAccessibleDescription('Keeps feet that stand from sliding');
  const locked = await app.onScreen();
  await page.getByRole('switch', { name: 'Hold hands' }).focus();
  await page.keyboard.press('Tab');
  await expect(lock).toBeFocused();
  await page.keyboard.press('Space');
  await expect(lock).not.toBeChecked();
  const free = await app.onScreen();
  expect(maxDistance(locked, free)).toBeGreaterThan(0.005);
  expect(await app.read(({ reaction, job }) => [reaction?.label, job])).toEqual(['demo reaction', null]);
  const frame = Math.round(30 * (await app.read(({ playback }) => playback.time)));
  for (const shown of [free, locked]) {
    const coming = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await page.getByRole('dialog', { name: 'Download' }).getByRole('button', { name: /BVH/ }).click();
    const { clip } = leaderBvh(readFileSync(await (await coming).path(), 'utf8'));
    const saved = Array.from(clip.positions.subarray(frame * 66, (frame + 1) * 66));
    expect(maxDistance(shown, saved)).toBeLessThan(0.001);
    await page.keyboard.press('Escape');
    await lock.click();
  }
});

test('hands that hold are set free at once, which undo takes back', async ({ page }) => {
  const app = new App(page);
  await app.open(SHIPPED);
  await app.settled();
  const hands = page.getByRole('switch', { name: 'Hold hands' });
  await expect(hands).toBeChecked();
  await hands.click();
  await expect(hands).not.toBeChecked();
  await app.until(({ reaction, job }) => reaction?.label === null && !job);
  const free = await app.reactor();
  await page.keyboard.press('Control+z');
  await expect(hands).toBeChecked();
  await app.until(({ reaction, job }) => reaction?.inputs.settings.holdHands && !job);
  expect(maxDistance(await app.reactor(), free)).toBeGreaterThan(0.05);
});

test('while a new leader waits for its partner, the lane shows no curve of the one before', async ({
  page,
}) => {
  await serveDemo(page, { guidance: {}, music: 1.5, variety: 1, seed: 77, role: 'reactor' });
  // The model never comes.
  await page.route('**/models/tiny/*.onnx', () => undefined);
  const app = new App(page);
  await app.openWithoutPicture();
  const lane = (name: RegExp) => page.getByRole('region', { name: 'Timeline' }).getByRole('img', { name });
  await expect(lane(/^Reactor speed/).locator('canvas')).toBeVisible();
  await app.drop(bvh({ frames: 60, name: 'mine.bvh' }));
  await expect(lane(/^No reactor yet/).locator('canvas')).toBeHidden();
});

test('a ready-made reaction plays before the model is loaded, and is not generated again', async ({
  page,
}) => {
  const column = { coarse: 0.5, fine: 0.25 };
  const guidance = { upper: column, lower: column, placement: column };
  const settings = { guidance, music: 1.5, variety: 1, seed: 77, role: 'reactor' };
  await serveDemo(page, settings);
  let release: () => void = () => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route('**/models/tiny/*.onnx', async (route) => {
    await held;
    await route.continue();
  });
  const app = new App(page);
  await app.openWithoutPicture();
  await page.getByRole('button', { name: 'Play the demo' }).click();
  await app.until(({ playback, reaction }) => playback.playing && playback.time > 0.2 && reaction);
  expect(await app.read(({ model }) => model.phase)).toBe('loading');
  await expect(page.getByRole('complementary')).toContainText('demo reaction');
  await expect(page.getByRole('spinbutton', { name: 'Seed' })).toHaveValue('77');
  release();
  await app.settled();
  expect(await app.read(({ reaction, job }) => [reaction?.label, job])).toEqual(['demo reaction', null]);
  // Steering it makes a reaction of this page's own.
  await page.getByRole('slider', { name: 'Fine guidance' }).fill('1');
  await app.until(({ reaction }) => reaction?.label === null);
});

test('without a ready-made reaction the partner of the demo is generated automatically', async ({ page }) => {
  await serveDemo(page, null);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.reaction('Made demo leader');
});

test('files of the visitor replace a demo that is still being loaded', async ({ page }) => {
  await serveDemo(page, null);
  let release: () => void = () => undefined;
  const held = new Promise<void>((resolve) => (release = resolve));
  await page.route('**/demo/leader.bvh', async (route) => {
    await held;
    await route.fallback();
  });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop({ name: 'mine.bvh', mimeType: '', buffer: Buffer.from(bvhText({ frames: 60 })) });
  await app.reaction('mine.bvh');
  release();
  await app.until(({ demo }) => demo === 'ready');
  expect(await app.read(({ leader, song }) => [leader?.name, song])).toEqual(['mine.bvh', null]);
});

test('a page without its demo says so and works', async ({ page }) => {
  await page.route('**/demo/*', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture();
  await expect(page.getByRole('region', { name: 'Start' })).toContainText('The demo could not be loaded');
  await expect(page.getByRole('button', { name: 'Play the demo' })).toBeHidden();
  await app.drop({ name: 'mine.bvh', mimeType: '', buffer: Buffer.from(bvhText({ frames: 60 })) });
  await app.reaction('mine.bvh');
});
