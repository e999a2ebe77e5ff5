import type { Page } from '@playwright/test';

/**
 * Resolves when the stage rests: nothing has been drawn for 400 ms, which is longer than it waits to draw a sharper last
 * picture. That nothing happens for a time is the fact itself here.
 * @returns pictures drawn until then
 */
export const rested = (page: Page): Promise<number> =>
  page.evaluate<number>(`new Promise((resolve) => {
    const { stage } = window.reactdance;
    (function look(last) {
      const { frames } = stage.stats();
      if (frames === last) resolve(frames);
      else setTimeout(() => look(frames), 400);
    })(NaN);
  })`);
