import { contactIntervals } from '../../motion/contact/foot-contacts';
import { leastSquaresShift, type Track } from '../../motion/contact/least-squares-shift';
import { gaussianFilter } from '../../motion/math/statistics';
import { shiftedLevel, type SolvedMotion } from '../../motion/skeleton/clip';
import { FEET, JOINT_COUNT } from '../../motion/skeleton/skeleton';

/** Weight of the place that was measured, where that of a foot that does not slide is 100. */
const PLACE_WEIGHT = 0.01;
/** Deviation of the smoothing of the floor's height under the feet, seconds. */
const FLOOR_DEVIATION = 0.25;

/**
 * Lets planted feet hold the body: the whole body is shifted level with the floor so that feet in contact slide as
 * little as possible, and up or down so that the lower foot stays on the floor.
 */
export function holdRoot(motion: SolvedMotion): SolvedMotion {
  const grounded = onGround(motion);
  const feet = FEET.map((joint) => ({ joint, contacts: contactIntervals(grounded, joint) }));
  const shift = (axis: 0 | 2): Float64Array => {
    const tracks: Track[] = feet.map(({ joint, contacts }) => ({
      contacts,
      positions: column(grounded, joint, axis),
    }));
    return leastSquaresShift(tracks, new Float64Array(grounded.frames).fill(PLACE_WEIGHT));
  };
  return shiftedLevel(grounded, shift(0), shift(2));
}

function column({ positions, frames }: SolvedMotion, joint: number, axis: number): Float64Array {
  return Float64Array.from({ length: frames }, (_, t) => positions[(t * JOINT_COUNT + joint) * 3 + axis]!);
}

/** The motion raised or lowered slowly, so that its lowest toe is at the floor. */
function onGround(motion: SolvedMotion): SolvedMotion {
  const heights = FEET.map((joint) => column(motion, joint, 1));
  const lowest = Float64Array.from({ length: motion.frames }, (_, t) =>
    Math.min(...heights.map((height) => height[t]!)),
  );
  const floor = gaussianFilter(lowest, FLOOR_DEVIATION * motion.fps);
  const lowered = (points: Float32Array): Float32Array => {
    const row = points.length / motion.frames;
    return points.map((value, i) => (i % 3 === 1 ? value - floor[Math.floor(i / row)]! : value));
  };
  return { ...motion, root: lowered(motion.root), positions: lowered(motion.positions) };
}
