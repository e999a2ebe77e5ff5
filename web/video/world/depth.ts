import { solveEven } from '../../motion/math/pentadiagonal';
import { median } from '../../motion/math/statistics';
import type { Series } from './series';
import type { Stances } from './stance';

/** Deviation of the depth that the size of the body tells, share of it, and frames over which it errs alike. */
const SIZE_DEVIATION = 0.05;
const SIZE_CORRELATION = 20;
/** Deviation of the second difference of the hips' depth from frame to frame, metres. */
const BEND_DEVIATION = 0.014;

/** What depths of feet and floor are found from. */
export interface DepthCues {
  readonly series: Series;
  /** frames x 33 x 3 in the camera's axes from the middle of the hips, metres. */
  readonly world: Float64Array;
  readonly stances: readonly Stances[];
  /** Pixels. */
  readonly focal: number;
}

/** Deviations from which on a frame's size counts less, and passes of iteratively reweighted least squares. */
const OUTLIER = 3;
const PASSES = 3;

/**
 * The depth of the hips in each frame: the least squares of what the body's size says and of a body that moves evenly.
 * Where the floor is does not help: a tilt of the camera that is wrong by a few degrees costs more than size errs.
 * @param size frames, metres
 */
export function depthOf(size: Float64Array): Float64Array {
  const deviation = SIZE_DEVIATION * median(size);
  const weight = 1 / (SIZE_CORRELATION * deviation ** 2);
  const weights = new Float64Array(size.length).fill(weight);
  let depth = size;
  for (let pass = 0; pass < PASSES; pass++) {
    const right = weights.map((one, t) => one * size[t]!);
    depth = solveEven(weights.slice(), right, 1 / BEND_DEVIATION ** 2);
    depth.forEach((metres, t) => {
      const error = (size[t]! - metres) / (OUTLIER * deviation);
      weights[t] = weight / (1 + error * error);
    });
  }
  return depth;
}
