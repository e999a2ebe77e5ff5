import { gaussianFilter, windowMaximum, windowMinimum } from '../math/statistics';
import { lowered, type SolvedMotion } from '../skeleton/clip';
import { J, JOINT_COUNT } from '../skeleton/skeleton';

/** Height of a toe up to which it stands, metres: a planted one is at 0.03. */
export const STANDING_HEIGHT = 0.045;
/** A hop is over after this time, seconds. */
const HOP = 0.5;
/** Standard deviation in time of the way down and up again, seconds. */
const SMOOTHING = 0.1;

/**
 * Brings a dancer down who stays off the floor for longer than a hop, as partners of unfamiliar leaders do who jump or
 * stand on tiptoe for long: where both toes are above `STANDING_HEIGHT` for half a second, the body is lowered by what
 * the lower toe is above it all that time (the morphological opening of its height). Hops and steps stay as they are,
 * and so does a motion without anything to lower. Pure.
 */
export function bringDown(motion: SolvedMotion): SolvedMotion {
  const reach = Math.round((HOP * motion.fps) / 2);
  const held = windowMaximum(windowMinimum(lowerToe(motion), reach), reach);
  const excess = held.map((height) => Math.max(0, height - STANDING_HEIGHT));
  if (!excess.some(Boolean)) return motion;
  return lowered(motion, gaussianFilter(excess, SMOOTHING * motion.fps));
}

/** Height of the lower of both toe joints, metres per frame. */
function lowerToe({ positions, frames }: SolvedMotion): Float64Array {
  const height = (frame: number, joint: number): number => positions[(frame * JOINT_COUNT + joint) * 3 + 1]!;
  return Float64Array.from({ length: frames }, (_, frame) =>
    Math.min(height(frame, J.left_foot), height(frame, J.right_foot)),
  );
}
