import type { Page } from '@playwright/test';
import { App } from './support/app-page';
import { bvh, wav } from './support/files';
import { expect, test } from './support/fixtures';
import { demoSettings, serveDemo } from './support/made-demo';
import { rested } from './support/stage-rest';

// A small phone: what draws here is the processor.
test.use({ viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true });

type Finger = readonly [x: number, y: number];

/** Puts fingers down one after the other, moves them together to where they go and lifts them. */
async function fingers(page: Page, from: readonly Finger[], to: readonly Finger[]): Promise<void> {
  const hand = await page.context().newCDPSession(page);
  const at = (part: number): { x: number; y: number; id: number }[] =>
    from.map(([x, y], id) => ({
      x: x + ((to[id]?.[0] ?? x) - x) * part,
      y: y + ((to[id]?.[1] ?? y) - y) * part,
      id,
    }));
  const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', touchPoints: ReturnType<typeof at>) =>
    hand.send('Input.dispatchTouchEvent', { type, touchPoints });
  for (let down = 1; down <= from.length; down++) await touch('touchStart', at(0).slice(0, down));
  for (const part of [0.25, 0.5, 0.75, 1]) await touch('touchMove', at(part));
  await touch('touchEnd', []);
  await hand.detach();
}

/** How far the camera stands from what it looks at, metres. */
const distance = (page: Page): Promise<number> =>
  page.evaluate<number>('window.reactdance.stage.framing().shot.distance');

/** How the page itself is zoomed and scrolled; fingers on stage and timeline leave that alone. */
const pageView = (page: Page): Promise<number[]> => page.evaluate('[visualViewport.scale, scrollX, scrollY]');

async function middle(page: Page, selector: string): Promise<Finger> {
  const box = await page.locator(selector).boundingBox();
  if (!box) throw new Error(`Nothing is seen of ${selector}.`);
  return [box.x + box.width / 2, box.y + box.height / 2];
}

test('two fingers zoom stage and timeline, and the page does not scroll', async ({ page }) => {
  await serveDemo(page, demoSettings);
  const app = new App(page);
  await app.open();
  await app.settled();
  await page.getByRole('button', { name: 'Play the demo' }).tap();
  await page.getByRole('button', { name: 'Pause' }).tap();
  await app.until(({ playback }) => !playback.playing);
  const time = await app.read(({ playback }) => playback.time);

  await test.step('the stage keeps the chosen distance', async () => {
    const [x, y] = await middle(page, '.picture');
    const far = await distance(page);
    await fingers(page, [[x - 50, y], [x + 50, y]], [[x - 90, y], [x + 90, y]]); // prettier-ignore
    await expect.poll(() => distance(page)).toBeLessThan(0.8 * far);
    const near = await distance(page);
    // That nothing takes the camera back for a time is what is tested.
    await page.waitForTimeout(800);
    expect(await distance(page)).toBeCloseTo(near, 1);
  });

  await test.step('the timeline zooms and the playhead does not move', async () => {
    const [x, y] = await middle(page, '.lane.song');
    await fingers(page, [[x - 40, y], [x + 40, y]], [[x - 120, y], [x + 120, y]]); // prettier-ignore
    await expect.poll(() => app.read(({ zoom }) => zoom && zoom.to - zoom.from)).toBeLessThan(2);
    expect(await app.read(({ playback }) => playback.time)).toBe(time);
  });

  await test.step('one finger drags the playhead', async () => {
    const [x, y] = await middle(page, '.lane.song');
    await fingers(page, [[x, y]], [[x + 60, y]]);
    await expect.poll(() => app.read(({ playback }) => playback.time)).not.toBe(time);
    expect(await pageView(page)).toEqual([1, 0, 0]);
  });

  await test.step('framing both, undo and the takes are on the first screen, large enough for fingers', async () => {
    for (const name of ['Undo', 'Redo', 'Frame both', /^Takes 1/]) {
      const box = await page.getByRole('button', { name }).boundingBox();
      expect(box?.height, String(name)).toBeGreaterThanOrEqual(44);
      expect((box?.y ?? 640) + (box?.height ?? 0), String(name)).toBeLessThan(400);
    }
    const near = await distance(page);
    // A tap right after a swipe stops what the swipe set in motion, and is no click: then the next one is.
    await expect(async () => {
      await page.getByRole('button', { name: 'Frame both' }).tap();
      await expect.poll(() => distance(page), { timeout: 2000 }).not.toBeCloseTo(near, 1);
    }).toPass({ timeout: 15_000 });
    await rested(page);
    const { width, height } = (await page.locator('.picture').boundingBox())!;
    const tools = (await page.getByRole('group', { name: 'Stage tools' }).boundingBox())!;
    const lowest = Math.max(...(await app.warmPixels())) / width;
    expect(lowest, 'the feet are above the tools').toBeLessThan(height - tools.height);
    const door = page.getByRole('button', { name: /^Takes/ });
    await door.tap();
    await expect(page.getByRole('dialog', { name: 'Takes' })).toBeVisible();
    await expect(page.getByRole('grid', { name: 'Takes' })).toBeVisible();
    await door.tap();
    await expect(page.getByRole('grid', { name: 'Takes' })).toBeHidden();
    await door.tap();
    await page.getByRole('button', { name: 'Close' }).tap();
    await expect(door).toBeFocused();
  });

  await test.step('a swipe over the timeline scrolls and moves no playhead', async () => {
    const before = await app.read(({ playback }) => playback.time);
    const [x, y] = await middle(page, '.lane.song');
    await fingers(page, [[x, y]], [[x, y - 120]]);
    await expect.poll(() => pageView(page).then(([, , scrolled]) => scrolled)).toBeGreaterThan(50);
    expect(await app.read(({ playback }) => playback.time)).toBe(before);
  });
});

test('a tap on the song says where a “1” is, where that was asked for, and else jumps', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.drop(bvh({ frames: 300, name: 'mine.bvh' }), wav({ seconds: 10, name: 'mine.wav' }));
  await app.reaction('mine.bvh');
  await app.until(({ reaction, song, job }) => song && reaction?.inputs.song === song && !job);
  await page.getByRole('button', { name: /Count/ }).tap();
  await page.getByRole('button', { name: 'Click a beat' }).tap();
  await page.touchscreen.tap(...(await middle(page, '.lane.song')));
  await expect.poll(() => app.read(({ countings }) => countings[0]?.one)).toBeCloseTo(5, 1);
  expect(await app.read(({ settingOne, playback }) => [settingOne, playback.time])).toEqual([false, 0]);
  await page.touchscreen.tap(...(await middle(page, '.lane.song')));
  await expect.poll(() => app.read(({ playback }) => playback.time)).toBeCloseTo(5, 1);
});

test('a small phone shows the whole first-visit block, and then stage and both faders together', async ({
  page,
}) => {
  const app = new App(page);
  await serveDemo(page, demoSettings);
  await app.openWithoutPicture();
  await app.settled();
  const stage = (await page.locator('#stage').boundingBox())!;
  for (const what of [
    page.getByRole('heading', { name: /Watch the partner answer/ }),
    page.getByRole('button', { name: 'Play the demo' }),
    page.getByRole('button', { name: 'Choose a song' }),
  ]) {
    const { y, height } = (await what.boundingBox())!;
    expect(y).toBeGreaterThan(stage.y);
    expect(y + height).toBeLessThan(stage.y + stage.height);
  }
  await page.getByRole('button', { name: 'Play the demo' }).tap();
  await app.until(({ playback }) => playback.playing);
  for (const name of ['Coarse guidance', 'Fine guidance'])
    await expect(page.getByRole('slider', { name })).toBeInViewport({ ratio: 1 });
  expect((await page.locator('#stage').boundingBox())!.height).toBeGreaterThan(240);

  await test.step('words beside each other do not overlap on the narrowest phones', async () => {
    await page.setViewportSize({ width: 320, height: 568 });
    for (const [left, right] of [
      ['.legend', '.views'],
      ['.count .unit:last-of-type', '.lane-label.quality-all'],
    ] as const) {
      const before = (await page.locator(left).boundingBox())!;
      const after = (await page.locator(right).boundingBox())!;
      expect(before.x + before.width, left).toBeLessThanOrEqual(after.x);
    }
  });
});

test.describe('on a tablet', () => {
  test.use({ viewport: { width: 768, height: 1024 } });

  test('the rows of the quality strip are as far apart as fingers need', async ({ page }) => {
    const app = new App(page);
    await app.openWithoutPicture();
    await app.settled();
    const labels = await page.locator('.lane-label.quality:visible').all();
    expect(labels).toHaveLength(4);
    const tops = await Promise.all(labels.map(async (label) => (await label.boundingBox())!.y));
    tops.sort((a, b) => a - b);
    for (const [above, top] of tops.slice(1).entries()) expect(top - tops[above]!).toBeGreaterThanOrEqual(24);
  });
});

test('the card says how much of the model has come, and nothing in the bar gives way where it fails', async ({
  page,
}) => {
  let fail = (): void => undefined;
  const held = new Promise<void>((resolve) => (fail = resolve));
  await page.route('**/models/tiny/step*', async (route) => {
    await held;
    await route.abort();
  });
  await serveDemo(page, demoSettings);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.until(({ model, reaction }) => model.phase === 'loading' && model.received > 14e6 && reaction);
  const badge = page.locator('.badge');
  await badge.getByRole('button').tap();
  const card = page.getByRole('dialog', { name: 'On this device' });
  await expect(card).toContainText(/is being downloaded: 14\.\d of 14\.\d MB\./);
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'New random seed' }).tap();
  const [words, meter] = [page.locator('.progress > span').first(), app.progress];
  await expect(words).toBeVisible();
  await expect(words).toContainText(/waiting for the model, 14\.\d of 14\.\d MB/);
  const [left, right] = [(await words.boundingBox())!, (await meter.boundingBox())!];
  expect(await words.evaluate((element) => element.scrollWidth - element.clientWidth)).toBe(0);
  expect(left.x + left.width).toBeLessThanOrEqual(right.x);
  const chip = page.getByRole('button', { name: /^Leader: / });
  const wide = (await chip.boundingBox())!.width;
  fail();
  await expect(badge.getByRole('button', { name: 'Try again' })).toBeVisible();
  expect((await chip.boundingBox())!.width).toBeGreaterThan(wide - 40);
});

test.describe('a phone of usual size', () => {
  test.use({ viewport: { width: 390, height: 844 } });

  test('shows the whole picture of a video while it is read', async ({ page }) => {
    const app = new App(page);
    await app.open();
    await app.settled();
    await page.getByRole('button', { name: 'A sample video' }).tap();
    const panel = page.getByRole('region', { name: 'Video of the leader' });
    const box = async () => (await panel.locator('.frame').boundingBox())!;
    // The shape of this video, which is upright.
    await expect.poll(async () => (await box()).height / (await box()).width).toBeGreaterThan(1);
    await expect(panel.getByRole('button', { name: 'Cancel' })).toBeVisible();
    const [frame, whole] = [await box(), await panel.boundingBox()];
    expect(frame.y + frame.height).toBeLessThanOrEqual(whole!.y + whole!.height);
    // On its side, the dancers have more than half of the stage.
    await page.setViewportSize({ width: 844, height: 390 });
    const stage = (await page.locator('#stage').boundingBox())!;
    await expect.poll(async () => (await panel.boundingBox())!.width / stage.width).toBeLessThan(0.4);
    await page.setViewportSize({ width: 390, height: 844 });
    await panel.getByRole('button', { name: 'Cancel' }).tap();
    await expect(panel).toBeHidden();
  });
});
