import type { Page } from '@playwright/test';
import { bvh } from '../support/files';
import { App } from '../support/app-page';
import { expect, test } from '../support/fixtures';
import { demoSettings, serveDemo } from '../support/made-demo';
import { rested } from '../support/stage-rest';

// A small picture is drawn as truly as a large one, and sooner.
test.use({ viewport: { width: 800, height: 600 } });

/** What still moves by CSS: everything on the page, seen or not, whose transitions or animations take time. */
const styled = (page: Page): Promise<string[]> =>
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

/** Notes every animation that runs from now on. */
async function watchAnimations(page: Page): Promise<() => Promise<string[]>> {
  await page.evaluate(`
    window.animated = new Set();
    (function look() {
      for (const animation of document.getAnimations())
        if (animation.effect.getComputedTiming().activeDuration > 10)
          window.animated.add(animation.constructor.name + ' ' + animation.effect.target.className);
      requestAnimationFrame(look);
    })();
  `);
  return () => page.evaluate<string[]>('[...window.animated]');
}

/** Pictures that the stage draws from `act` until it rests again. */
async function drawn(page: Page, act: () => Promise<void>): Promise<number> {
  const before = await rested(page);
  await act();
  return (await rested(page)) - before;
}

/** Of a jump: the new place, what that brings with it, and each once more sharper where pictures come late. */
const JUMP = 4;

test('who wants less movement sees none but the dance, from the moment they say so', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await serveDemo(page, demoSettings);
  const app = new App(page);
  await app.open();
  await app.settled();
  await page.evaluate('window.reactdance.stage.ready()');
  const view = (name: string) => () => page.getByRole('radio', { name, exact: true }).click();

  await test.step('nothing moves by itself', async () => {
    // That nothing happens for a time is what is tested.
    expect(await drawn(page, () => page.waitForTimeout(1000))).toBe(0);
    expect(await app.read(({ playback }) => [playback.playing, playback.time])).toEqual([false, 0]);
    expect(await styled(page)).toEqual([]);
  });

  await test.step('no control moves more than at once', async () => {
    const animated = await watchAnimations(page);
    await page.getByRole('button', { name: 'Play the demo' }).click();
    await app.until(({ playback }) => playback.time > 0.2);
    await page.keyboard.press('Space');
    const matrix = page.getByRole('button', { name: /By body part/ });
    await matrix.click();
    await matrix.click();
    await page.getByRole('switch', { name: 'Foot lock' }).click();
    await page.getByRole('button', { name: 'Roll a new seed' }).click();
    await app.until(({ reaction, job }) => !job && reaction?.label === null);
    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: /^Switch to / }).click();
    expect(await animated()).toEqual([]);
  });

  await test.step('the camera jumps, and does not run after the couple', async () => {
    await app.chooseLeader(bvh({ frames: 100, sway: 6, name: 'far.bvh' }));
    await app.reaction('far.bvh');
    await page.evaluate('window.reactdance.stage.ready()');
    expect(await drawn(page, view('Top'))).toBeLessThanOrEqual(JUMP);
    expect(await drawn(page, view('Follow'))).toBeLessThanOrEqual(JUMP);
    await page.evaluate('document.activeElement.blur()');
    expect(await drawn(page, () => page.keyboard.press('End'))).toBeLessThanOrEqual(JUMP);
    expect(await app.read(({ playback }) => playback.time)).toBeGreaterThan(3);
  });

  await test.step('and glides for who changes their mind', async () => {
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    expect(await styled(page)).not.toEqual([]);
    expect(await drawn(page, view('Top'))).toBeGreaterThan(JUMP);
    await view('Follow')();
    await page.evaluate('new Promise(requestAnimationFrame)');
    // Said in the middle of a flight, it ends there and then.
    await page.emulateMedia({ reducedMotion: 'reduce' });
    expect(await drawn(page, () => Promise.resolve())).toBeLessThanOrEqual(JUMP);
    expect(await styled(page)).toEqual([]);
  });
});
