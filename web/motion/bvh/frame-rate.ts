import { AppError } from '../../common/error';

/** Frame rates that recordings have; a frame time is written with few decimals and rarely hits one exactly. */
const USUAL = [
  24, 25, 30, 48, 50, 60, 72, 75, 90, 100, 120, 144, 150, 180, 200, 240, 250, 300, 360, 480, 500,
];
const SLOWEST = 5;
const FASTEST = 1000;
/** However few decimals are written, a rate that is further away (as a part of the frame time) is not meant. */
const CLOSE = 0.02;

/**
 * Frames per second from a frame time in seconds as written. When a usual rate lies within the last written decimal
 * it is meant: 0.0333 is 30, 0.008333 is 120, but 0.0333667 stays 29.97.
 *
 * @throws {AppError} `bad-frame-time`
 */
export function frameRate(frameTime: string): number {
  const seconds = Number(frameTime);
  if (frameTime === '' || !(seconds > 0) || 1 / seconds > FASTEST || 1 / seconds < SLOWEST) {
    throw new AppError(
      'bad-frame-time',
      `The file states a frame time of "${frameTime.slice(0, 24)}" seconds, which no dance is recorded with.`,
      `Set the frame rate by hand, or correct the line "Frame Time:" in the file (30 frames per second: 0.033333).`,
    );
  }
  const decimals = /\.(\d*)/.exec(frameTime)?.[1]?.length ?? 0;
  const lastDecimal = /e/i.test(frameTime) ? seconds * 1e-6 : 10 ** -decimals;
  const away = (rate: number): number => Math.abs(1 / rate - seconds);
  const meant = USUAL.filter((rate) => away(rate) <= Math.min(lastDecimal, CLOSE * seconds));
  return meant.sort((a, b) => away(a) - away(b))[0] ?? 1 / seconds;
}

/**
 * Checks a rate that a person has set.
 *
 * @throws {AppError} `bad-frame-time`
 */
export function givenRate(fps: number): number {
  if (fps >= SLOWEST && fps <= FASTEST) return fps;
  throw new AppError(
    'bad-frame-time',
    `${fps} frames per second is no frame rate of a dance.`,
    `Choose a rate between ${SLOWEST} and ${FASTEST}; most recordings have 30, 60 or 120.`,
  );
}
