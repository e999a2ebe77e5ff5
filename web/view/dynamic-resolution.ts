import { median } from '../motion/math/statistics';

/**
 * Chooses the resolution of a moving picture so that the stage moves smoothly on any machine. A computer without a
 * graphics card draws the stage in a tenth of a second; at half the pixels along each side it takes a third of that.
 */
export interface DynamicResolution {
  /** Share of the pixels along a side that a moving picture has; 1 is all of them. */
  readonly share: number;
  /** Takes note of a frame of a moving stage: milliseconds from when it was asked for to when it could be drawn. */
  frameWaited(ms: number): void;
}

const SHARES = [1, Math.SQRT1_2, 0.5] as const;
/** Frames that wait longer than this stutter; after so many of them the next ones have a lower resolution. */
const SLOW_MS = 50;
const SLOW_FRAMES = 5;
/** With waits as short as this there is time for twice the pixels; it takes a second of such frames to try. */
const QUICK_MS = 20;
const QUICK_FRAMES = 60;
/** After a trial that was too slow the next one takes this many times as many quick frames. */
const RETRY_FACTOR = 4;

export function createDynamicResolution(): DynamicResolution {
  let level = 0;
  let quickFramesNeeded = QUICK_FRAMES;
  let trial = false;
  let recent: number[] = [];
  let quickFrames = 0;

  function setLevel(next: number): void {
    level = next;
    recent = [];
    quickFrames = 0;
  }
  return {
    get share() {
      return SHARES[level]!;
    },
    frameWaited(ms) {
      recent = [...recent, ms].slice(-SLOW_FRAMES);
      quickFrames = ms < QUICK_MS ? quickFrames + 1 : 0;
      const slow = recent.length === SLOW_FRAMES && median(recent) > SLOW_MS;
      if (slow && level + 1 < SHARES.length) {
        if (trial) quickFramesNeeded *= RETRY_FACTOR;
        trial = false;
        setLevel(level + 1);
      } else if (quickFrames >= quickFramesNeeded && level > 0) {
        trial = true;
        setLevel(level - 1);
      }
    },
  };
}
