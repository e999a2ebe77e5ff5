import { FPS } from '../../motion/skeleton/clip';
import type { ContactInterval } from '../../motion/contact/foot-contacts';
import { gaussianFilter, runsBelow, runsOf } from '../../motion/math/statistics';
import { J, SIDES } from '../../motion/skeleton/skeleton';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { L } from '../pose/landmark-names';
import type { Series } from './series';

/**
 * A part of a foot that can stand: its joint, the landmark on the sole below it, and the landmarks of which one at rest
 * tells that it stands. Networks turn a standing foot about its ankle with the body, so that its toe and heel move; where
 * the toe alone is at rest the dancer is on the ball of the foot.
 */
const SOLES = SIDES.flatMap((side) => [
  { joint: J[`${side}_ankle`], landmark: L[`${side}_heel`], still: [L[`${side}_ankle`]] },
  { joint: J[`${side}_foot`], landmark: L[`${side}_toe`], still: [L[`${side}_toe`], L[`${side}_ankle`]] },
]);

/** Deviation of the smoothing of the landmarks' places in the picture, seconds. */
const DEVIATION = 0.06;
/** A stance begins below the first speed and ends above the second, m/s at the dancer's distance. */
const STILL = 0.2;
const MOVING = 0.4;
/** Shortest stance, seconds. */
const MIN_DURATION = 0.13;

/** The stances of one part of a foot. */
export interface Stances {
  readonly joint: number;
  readonly landmark: number;
  readonly intervals: readonly ContactInterval[];
}

/** Where a landmark is seen, as slopes of its ray, x / z and y / z, one a frame. */
export interface Rays {
  readonly x: Float64Array;
  readonly y: Float64Array;
}

/** The rays of a landmark, smoothed. */
export function raysOf({ image, frames, width, height }: Series, landmark: number, focal: number): Rays {
  const column = (axis: 0 | 1): Float64Array =>
    gaussianFilter(
      Float64Array.from({ length: frames }, (_, frame) => {
        const pixel = image[2 * (frame * LANDMARK_COUNT + landmark) + axis]!;
        return (pixel - (axis === 0 ? width : height) / 2) / focal;
      }),
      DEVIATION * FPS,
    );
  return { x: column(0), y: column(1) };
}

/**
 * When the parts of the feet stand, by hysteresis of their speed in the picture: what stands on the floor stands still
 * there, whatever the depth.
 * @param depth frames, metres
 */
export function stancesOf(series: Series, depth: Float64Array, focal: number): Stances[] {
  return SOLES.map(({ joint, landmark, still }) => {
    const stands = new Array<boolean>(series.frames).fill(false);
    for (const one of still)
      for (const { from, to } of runsBelow(speedOf(raysOf(series, one, focal), depth), STILL, MOVING))
        if (to - 1 - from >= MIN_DURATION * FPS) stands.fill(true, from, to);
    const intervals = runsOf(stands).map(({ from, to }) => ({ first: from, last: to - 1 }));
    return { joint, landmark, intervals };
  });
}

/** Speed across the line of sight, m/s. */
function speedOf({ x, y }: Rays, depth: Float64Array): Float64Array {
  return depth.map((metres, t) => {
    const [a, b] = [Math.max(0, t - 1), Math.min(depth.length - 1, t + 1)];
    return (metres * Math.hypot(x[b]! - x[a]!, y[b]! - y[a]!) * FPS) / Math.max(1, b - a);
  });
}
