import { AppError } from '../../common/error';

/**
 * Common frame rates of recordings; a frame time is written with few decimals and rarely hits one exactly. They are so far
 * apart that no rate is within `TOLERANCE` of two of them.
 */
const COMMON_RATES = [
  24, 25, 30, 48, 50, 60, 72, 75, 90, 100, 120, 144, 150, 180, 200, 240, 250, 300, 360, 480, 500,
];
/** Frames per second of a file that does not state them. */
export const ASSUMED_FPS = 30;
/** Accepted frame rates. */
const MIN_FPS = 5;
const MAX_FPS = 1000;
/** Largest deviation from a common rate, as a share of the frame time, however few decimals are written. */
const TOLERANCE = 0.02;

/**
 * Frames per second from a frame time in seconds as written. A common rate within the last written decimal is
 * taken instead: 0.0333 is 30, 0.008333 is 120, but 0.0333667 stays 29.97.
 *
 * @throws {AppError} `bad-frame-time`
 */
export function frameRate(frameTime: string): number {
  const seconds = Number(frameTime);
  if (frameTime === '' || !(seconds > 0) || 1 / seconds > MAX_FPS || 1 / seconds < MIN_FPS) {
    throw new AppError(
      'bad-frame-time',
      `The file states a frame time of "${frameTime.slice(0, 24)}" seconds, which cannot be right for a dance.`,
      `Set the frame rate by hand, or correct the line "Frame Time:" in the file (30 frames per second: 0.033333).`,
    );
  }
  const decimals = /\.(\d*)/.exec(frameTime)?.[1]?.length ?? 0;
  const lastDecimal = /e/i.test(frameTime) ? seconds * 1e-6 : 10 ** -decimals;
  const accepted = Math.min(lastDecimal, TOLERANCE * seconds);
  return COMMON_RATES.find((rate) => Math.abs(1 / rate - seconds) <= accepted) ?? 1 / seconds;
}

/** The common rate that is within `TOLERANCE` of one that was measured; null where none is. */
export function nearestRate(fps: number): number | null {
  return COMMON_RATES.find((rate) => Math.abs(rate / fps - 1) < TOLERANCE) ?? null;
}

/**
 * Checks a frame rate that the user has set.
 *
 * @throws {AppError} `bad-frame-time`
 */
export function checkedRate(fps: number): number {
  if (fps >= MIN_FPS && fps <= MAX_FPS) return fps;
  throw new AppError(
    'bad-frame-time',
    `${fps} frames per second cannot be right for a dance.`,
    `Choose a rate between ${MIN_FPS} and ${MAX_FPS}; most recordings have 30, 60 or 120.`,
  );
}
