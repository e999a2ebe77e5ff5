import { gaussianFilter } from '../math/statistics';
import type { SolvedMotion } from '../skeleton/clip';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { STANDING_HEIGHT } from './bring-down';
import { CONTACT_SPEED, RELEASE_SPEED, slowestFootSpeed } from './foot-contacts';
import { footShift } from './least-squares-shift';
import { withShiftedFeet } from './shifted-limb';

/** Standard deviation of the Gaussian filter over the speed of the slowest joint, seconds. */
const SPEED_SMOOTHING = 2 / 30;
/** How high a foot is lifted in a step, metres. */
const STEP_HEIGHT = 0.05;
/**
 * Weights of a slide while a foot stands and of the shift's second difference, both above the foot lock's: shifts are
 * long here, and a foot that flies to its next place is not to jerk.
 */
const STAND_WEIGHT = 1000;
const SMOOTHNESS_WEIGHT = 200;

/**
 * How far a dancer slides on both feet, from each frame to the next; frames - 1 numbers. It is 0 up to the speed at which
 * the foot lock holds a foot and 1 from that on at which it lets it go. Captured salsa dancers are above the first in 1 %
 * of the frames.
 */
function slidingOf(motion: SolvedMotion): Float64Array {
  return gaussianFilter(slowestFootSpeed(motion), SPEED_SMOOTHING * motion.fps).map((speed) =>
    Math.min(1, Math.max(0, (speed - CONTACT_SPEED) / (RELEASE_SPEED - CONTACT_SPEED))),
  );
}

/**
 * Footstep synthesis: a dancer who slides over the floor on both feet, as one whose partner travels farther than the legs
 * were made to step, steps instead. In turn, each foot stands on the floor for a step and is lifted to its next place in
 * the other's, the more so the faster both slide; elsewhere nothing changes. Joints above the knees do not move, feet keep
 * their rotations. Pure.
 *
 * Which foot stands is told by the count of steps alone, so motions that differ little step alike: while guidance is
 * changed, the feet go smoothly with it.
 *
 * @param counts steps that have been taken by each frame (`stepCounts`): a foot comes down where it becomes whole
 */
export function withFootsteps(motion: SolvedMotion, counts: Float64Array): SolvedMotion {
  const { frames } = motion;
  if (frames < 2) return motion;
  const sliding = slidingOf(motion);
  if (!sliding.some(Boolean)) return motion;
  return withShiftedFeet(motion, (leg, side) => {
    /** How far a foot is through its step: negative while it stands, 0 to 1 while it flies. */
    const flight = (frame: number): number => {
      const half = (counts[frame]! + side) / 2;
      return 2 * (half - Math.floor(half)) - 1;
    };
    const held = sliding.map((share, frame) => (flight(frame) < 0 ? STAND_WEIGHT * share : 0));
    const raised = Float64Array.from({ length: frames }, (_, frame) => {
      const lift = Math.sin(Math.PI * Math.max(0, flight(frame))) ** 2;
      // Who slides may hover too: both feet go down to the floor before one of them is lifted.
      const toe = motion.positions[(frame * JOINT_COUNT + leg.toe) * 3 + 1]!;
      const above = Math.max(0, toe - STANDING_HEIGHT);
      return (STEP_HEIGHT * lift - above) * sliding[Math.min(frame, frames - 2)]!;
    });
    return { ...footShift(motion, leg, { weights: () => held, smoothness: SMOOTHNESS_WEIGHT }), y: raised };
  });
}
