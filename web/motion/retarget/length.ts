/** How long a motion may be. */
import { AppError } from '../../common/error';

/** Largest number of values that is read: 15 minutes of 60 joints at 60 frames per second. */
const MAX_VALUES = 1e7;

/**
 * @param width values of one frame
 * @throws {AppError} `too-long` where the motion has more values than are read
 */
export function refuseTooLong(frames: number, width: number): void {
  if (frames * width <= MAX_VALUES) return;
  throw new AppError(
    'too-long',
    `The file has ${frames} frames of ${width} values; up to ${MAX_VALUES / 1e6} million values are read.`,
    'Export a shorter part of the dance, fewer frames per second, or the body without fingers.',
  );
}

/** @throws {AppError} `too-few-frames` where the motion has fewer than two */
export function refuseTooFew(frames: number): void {
  if (frames >= 2) return;
  throw new AppError(
    'too-few-frames',
    frames === 1 ? 'The file holds one frame, a pose and not a motion.' : 'The file holds no frames.',
    'Export the whole animation, not only its current frame.',
  );
}
