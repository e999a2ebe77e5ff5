import { App, SHIPPED } from './support/app-page';
import { expect, test } from './support/fixtures';

test.use({ shippedDemo: true });

test('worst moments of the demo are marked, a click goes there, and the foot lock changes the numbers', async ({
  page,
}) => {
  await page.setViewportSize({ width: 1440, height: 900 });
  const app = new App(page);
  await app.openWithoutPicture(SHIPPED);
  await app.until(({ demo, reading, quality }) => demo === 'ready' && !reading.song && quality);
  const timeline = page.getByRole('region', { name: 'Timeline' });
  const feet = timeline.getByRole('img', { name: /^Feet / });
  await expect(feet).toHaveAccessibleName(/^Feet \d+ %: Feet slide \d+ % of the time they touch the floor/);
  for (const name of [
    /^Closest 0\.\d\d m: /,
    /^Beats 0\.\d\d 0\.\d\d: .*With the music/,
    /^Seams \d\.\d\d: /,
  ])
    await expect(timeline.getByRole('img', { name })).toBeVisible();

  // The page knows what the recorded dancers of this model score.
  await expect(feet).toHaveAccessibleName(/recorded dancers: \d+ %/);

  const mark = timeline.getByRole('button', { name: /^1\. .* (at|around) 0:\d\d\.\d$/ });
  await expect(mark).toHaveText('1');
  // No alarm before someone looks at the strip.
  await expect(mark).toHaveCSS('opacity', '0');
  await page.locator('.lane.quality-feet').hover();
  await expect(mark).toHaveCSS('opacity', '1');
  await page.mouse.move(400, 5);
  await expect(mark).toHaveCSS('opacity', '0');
  const [, seconds = ''] = /0:(\d\d\.\d)$/.exec((await mark.getAttribute('aria-label')) ?? '') ?? [];
  expect(await app.read(({ playback }) => playback.time)).not.toBeCloseTo(Number(seconds), 0);
  await mark.click();
  const { region, loop, playing } = await app.read(({ playback }) => playback);
  expect([loop, playing]).toEqual([true, true]);
  expect(Math.abs((region?.from ?? 0) + 0.5 - Number(seconds))).toBeLessThan(0.11);
  // Two seconds, or less at the end of the dance.
  const end = await app.read(({ reaction }) =>
    reaction ? (reaction.motion.frames - 1) / reaction.motion.fps : 0,
  );
  expect((region?.to ?? 0) - (region?.from ?? 0)).toBeCloseTo(Math.min(2, end - (region?.from ?? 0)), 1);
  await page.keyboard.press('Space');
  await expect(page.getByRole('slider', { name: 'Playhead' })).toHaveAttribute('aria-valuetext', /./);

  // What a mark means is seen under the pointer, with the focus and after a tap, and nothing moves for it.
  const card = page.getByRole('tooltip');
  await expect(card).toContainText(`0:${seconds}`);
  await expect(mark).toHaveAccessibleDescription(/\. (Up|By|Around) .*\.$/);
  const place = await mark.boundingBox();
  // After a click and a key it does not stay over the other marks.
  await page.mouse.move(400, 5);
  await expect(card).toBeHidden();
  await mark.hover();
  await expect(card).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(card).toBeHidden();
  await page.mouse.move(400, 5);
  await mark.hover();
  await expect(card).toBeVisible();
  await page.mouse.move(400, 5);
  await page.evaluate('document.activeElement.blur()');
  await expect(card).toBeHidden();
  expect(await mark.boundingBox()).toEqual(place);
  const label = timeline.getByRole('button', { name: /^Feet/ });
  await label.focus();
  await expect(card).toContainText('of the time they touch the floor');
  await page.keyboard.press('Tab');
  await expect(card).not.toContainText('of the time they touch the floor');

  const share = async (): Promise<number> =>
    Number(/(\d+) %/.exec((await feet.getAttribute('aria-label')) ?? '')?.[1]);
  const locked = await share();
  await page.getByRole('switch', { name: 'Foot lock' }).click();
  await expect.poll(share).toBeGreaterThan(locked + 10);
  await page.getByRole('switch', { name: 'Foot lock' }).click();
  await expect.poll(share).toBe(locked);

  // In a low window one lane holds the worst of the four, and its marks work by key.
  await page.setViewportSize({ width: 1280, height: 720 });
  await expect(feet).toBeHidden();
  await expect(timeline.getByRole('img', { name: /^Quality/ })).toBeVisible();
  await timeline.getByRole('button', { name: 'Quality' }).hover();
  await expect(card.getByRole('listitem')).toHaveCount(6);
  await expect(card.getByRole('listitem').first()).toContainText(
    /Feet slide.*\d+ %.*recorded \d+ %.*(good|so-so|poor)/,
  );
  const [over, below] = [await card.boundingBox(), await timeline.boundingBox()];
  expect(over && below && over.y + over.height <= below.y).toBe(true);
  const second = timeline.getByRole('button', { name: /^2\. / });
  await second.focus();
  const before = await app.read(({ playback }) => playback.time);
  await page.keyboard.press('Enter');
  await app.until(({ playback }, time) => playback.time !== time, before);
});
