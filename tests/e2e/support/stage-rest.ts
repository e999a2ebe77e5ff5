import type { Page } from '@playwright/test';

/**
 * Resolves when the stage rests: it has drawn no frame for 400 ms, which is longer than the delay of the last frame at
 * full resolution.
 * @returns number of frames drawn so far
 */
export const rested = (page: Page): Promise<number> =>
  page.evaluate<number>(`new Promise((resolve) => {
    const { stage } = window.reactdance;
    (function check(last) {
      const { frames } = stage.stats();
      if (frames === last) resolve(frames);
      else setTimeout(() => check(frames), 400);
    })(NaN);
  })`);
