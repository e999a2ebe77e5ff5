import { AppError } from '../common/error';
import { median } from '../motion/math/statistics';
import type { Observations } from './observations';
import { LANDMARK_COUNT } from './pose/landmarks';
import { L } from './pose/landmark-names';
import { MAX_BRIDGE, rowsSeen } from './world/series';

/** Mean brightness below which a picture counts as black. */
const BLACK = 0.03;
/** Visibility of the ankles below which the legs are not in the picture. */
const MIN_ANKLES = 0.3;
/** Shortest dance, seconds. */
const MIN_SECONDS = 1;

/**
 * Checks that one whole dancer was seen long enough to make a motion of.
 * @throws {AppError} `video-black`, `no-person`, `video-too-short`, `half-a-body`
 */
export function checkSeen(observations: Observations): void {
  const { times } = observations;
  const rows = rowsSeen(observations);
  if (rows.length === 0) {
    if (observations.brightest < BLACK)
      throw new AppError(
        'video-black',
        'The video is black.',
        'Check that the camera was not covered and that the video plays elsewhere, then choose it again.',
      );
    throw new AppError(
      'no-person',
      'No person was found in the video.',
      'Film one dancer from head to feet, in light, with a camera that stays in its place.',
    );
  }
  const seconds = secondsSeen(rows, times);
  if (seconds < MIN_SECONDS)
    throw new AppError(
      'video-too-short',
      `The dancer is seen for ${seconds.toFixed(1)} s only.`,
      'Choose a video in which one dancer is seen for at least a second, better for ten.',
    );
  if (median(rows.map((row) => ankleVisibility(observations, row))) < MIN_ANKLES)
    throw new AppError(
      'half-a-body',
      'The dancer’s legs are not in the picture for most of the video.',
      'Step back or turn the phone upright, so that the whole body is seen from head to feet.',
    );
}

/** How long the person is seen, short gaps included. */
function secondsSeen(rows: readonly number[], times: Float64Array): number {
  let sum = 0;
  rows.slice(1).forEach((row, i) => {
    const before = rows[i]!;
    const step = times[row]! - times[before]!;
    if (step <= MAX_BRIDGE || row === before + 1) sum += step;
  });
  return sum;
}

/** Visibility of the better ankle; 0 where it is outside the picture. */
function ankleVisibility({ image, visibility, width, height }: Observations, row: number): number {
  return Math.max(
    ...[L.left_ankle, L.right_ankle].map((landmark) => {
      const i = row * LANDMARK_COUNT + landmark;
      const [x, y] = [image[2 * i]!, image[2 * i + 1]!];
      return x >= 0 && y >= 0 && x <= width && y <= height ? visibility[i]! : 0;
    }),
  );
}
