import type { Page } from '@playwright/test';
import { bvh } from '../support/files';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { demoSettings, serveDemo } from '../support/made-demo';
import { rested } from '../support/stage-rest';

// A small picture is enough, and drawn sooner.
test.use({ viewport: { width: 800, height: 600 } });

/** Elements whose CSS transitions or animations take time. */
const animatedByCss = (page: Page): Promise<string[]> =>
  page.evaluate(() => {
    const longest = (times: string): number =>
      Math.max(...times.split(',').map((time) => parseFloat(time) * (time.trim().endsWith('ms') ? 1 : 1000)));
    const found: string[] = [];
    for (const element of document.querySelectorAll('*'))
      for (const part of ['', '::before', '::after', '::backdrop', '::marker', '::placeholder']) {
        const style = getComputedStyle(element, part);
        const taken = longest(style.transitionDuration);
        const animated = style.animationName === 'none' ? 0 : longest(style.animationDuration);
        if (Math.max(taken, animated) > 10)
          found.push(`${element.localName}.${element.getAttribute('class') ?? ''}${part}`);
      }
    return found;
  });

/** Records every animation that runs from now on; the result returns them. */
async function watchAnimations(page: Page): Promise<() => Promise<string[]>> {
  await page.evaluate(`
    window.animated = new Set();
    (function check() {
      for (const animation of document.getAnimations())
        if (animation.effect.getComputedTiming().activeDuration > 10)
          window.animated.add(animation.constructor.name + ' ' + animation.effect.target.className);
      requestAnimationFrame(check);
    })();
  `);
  return () => page.evaluate<string[]>('[...window.animated]');
}

/** Number of frames that the stage draws from `act` until it rests again. */
async function drawnFrames(page: Page, act: () => Promise<void>): Promise<number> {
  const before = await rested(page);
  await act();
  return (await rested(page)) - before;
}

/** Most frames that are drawn for a jump of the camera. */
const MAX_JUMP_FRAMES = 4;

test('with reduced motion nothing but the dance moves, as soon as it is preferred', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await serveDemo(page, demoSettings);
  const app = new App(page);
  await app.open();
  await app.settled();
  await page.evaluate('window.reactdance.stage.ready()');
  const view = (name: string) => () => page.getByRole('radio', { name, exact: true }).click();

  await test.step('nothing moves by itself', async () => {
    // That nothing happens for a time is what is tested.
    expect(await drawnFrames(page, () => page.waitForTimeout(1000))).toBe(0);
    expect(await app.read(({ playback }) => [playback.playing, playback.time])).toEqual([false, 0]);
    expect(await animatedByCss(page)).toEqual([]);
  });

  await test.step('no control is animated', async () => {
    const animated = await watchAnimations(page);
    await page.getByRole('button', { name: 'Play the demo' }).click();
    await app.until(({ playback }) => playback.time > 0.2);
    await page.keyboard.press('Space');
    const matrix = page.getByRole('button', { name: /By body part/ });
    await matrix.click();
    await matrix.click();
    await page.getByRole('switch', { name: 'Foot lock' }).click();
    await page.getByRole('button', { name: 'New random seed' }).click();
    await app.until(({ reaction, job }) => !job && reaction?.label === null);
    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: /^Switch to / }).click();
    expect(await animated()).toEqual([]);
  });

  await test.step('the camera jumps, and does not follow the couple smoothly', async () => {
    await app.chooseLeader(bvh({ frames: 100, sway: 6, name: 'far.bvh' }));
    await app.reaction('far.bvh');
    await page.evaluate('window.reactdance.stage.ready()');
    expect(await drawnFrames(page, view('Top'))).toBeLessThanOrEqual(MAX_JUMP_FRAMES);
    expect(await drawnFrames(page, view('Follow'))).toBeLessThanOrEqual(MAX_JUMP_FRAMES);
    await page.evaluate('document.activeElement.blur()');
    expect(await drawnFrames(page, () => page.keyboard.press('End'))).toBeLessThanOrEqual(MAX_JUMP_FRAMES);
    expect(await app.read(({ playback }) => playback.time)).toBeGreaterThan(3);
  });

  await test.step('the camera moves smoothly again when reduced motion is switched off', async () => {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    expect(await animatedByCss(page)).not.toEqual([]);
    expect(await drawnFrames(page, view('Top'))).toBeGreaterThan(MAX_JUMP_FRAMES);
    await view('Follow')();
    await page.evaluate('new Promise(requestAnimationFrame)');
    // Switched on during a camera move, it ends the move at once.
    await page.emulateMedia({ reducedMotion: 'reduce' });
    expect(await drawnFrames(page, () => Promise.resolve())).toBeLessThanOrEqual(MAX_JUMP_FRAMES);
    expect(await animatedByCss(page)).toEqual([]);
  });
});
