import { median } from '../motion/math/statistics';

/**
 * How sharp pictures may be so that the stage moves smoothly on any machine. A computer without a graphics card draws
 * the stage in a tenth of a second; at half the pixels along each side it takes a third of that.
 */
export interface Sharpness {
  /** Share of the pixels along a side that a moving picture has; 1 is all of them. */
  readonly factor: number;
  /** Takes note of a picture of a moving stage: milliseconds from when it was asked for to when it could be drawn. */
  waited(ms: number): void;
}

const FACTORS = [1, Math.SQRT1_2, 0.5] as const;
/** Pictures that come later than this jerk, milliseconds; after so many of them the next ones are less sharp. */
const SLOW = 50;
const SLOW_PICTURES = 5;
/** With pictures as quick as this there is time for twice the pixels; it takes a second of them to try. */
const QUICK = 20;
const QUICK_PICTURES = 60;
/** After a trial that was too slow the next one waits so much longer. */
const PATIENCE = 4;

export function createSharpness(): Sharpness {
  let level = 0;
  let needed = QUICK_PICTURES;
  let tried = false;
  let recent: number[] = [];
  let quick = 0;

  function take(next: number): void {
    level = next;
    recent = [];
    quick = 0;
  }
  return {
    get factor() {
      return FACTORS[level]!;
    },
    waited(ms) {
      recent = [...recent, ms].slice(-SLOW_PICTURES);
      quick = ms < QUICK ? quick + 1 : 0;
      const slow = recent.length === SLOW_PICTURES && median(recent) > SLOW;
      if (slow && level + 1 < FACTORS.length) {
        if (tried) needed *= PATIENCE;
        tried = false;
        take(level + 1);
      } else if (quick >= needed && level > 0) {
        tried = true;
        take(level - 1);
      }
    },
  };
}
