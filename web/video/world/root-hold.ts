import type { ContactInterval } from '../../motion/contact/foot-contacts';
import { lockFeet } from '../../motion/contact/foot-lock';
import { contactWeights, leastSquaresShift } from '../../motion/contact/least-squares-shift';
import { solveEven } from '../../motion/math/pentadiagonal';
import { percentile } from '../../motion/math/statistics';
import { lowered, shiftedLevel, type SolvedMotion } from '../../motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { Stances } from './stance';

/** Weight of the place that was measured, where that of a foot that does not slide is 100. */
const PLACE_WEIGHT = 1;
/** The same for the height that was measured, where that of a toe that stands on the floor is 1. */
const HEIGHT_WEIGHT = 0.02;
/** Weight of an even change of height. */
const EVEN_WEIGHT = 200;
/** Weight of a standing foot that does not slide: more than for motions that were captured, whose feet slide less. */
const LOCK_WEIGHT = 2000;
const TOES = [J.left_foot, J.right_foot];

/**
 * Lets standing feet hold the body: it is shifted level with the floor so that they slide as little as possible, and up
 * or down so that standing toes are on the floor; what is left is taken by the legs.
 */
export function holdRoot(motion: SolvedMotion, stances: readonly Stances[]): SolvedMotion {
  const grounded = onGround(motion, stances);
  const shift = (axis: 0 | 2): Float64Array =>
    leastSquaresShift(
      stances.map(({ joint, intervals }) => ({
        weights: contactWeights(grounded.frames, intervals),
        positions: column(grounded, joint, axis),
      })),
      new Float64Array(grounded.frames).fill(PLACE_WEIGHT),
    );
  const held = shiftedLevel(grounded, shift(0), shift(2));
  return lockFeet(held, { contacts: contactsOf(stances), weight: LOCK_WEIGHT });
}

function contactsOf(stances: readonly Stances[]): (joint: number) => readonly ContactInterval[] {
  return (joint) => stances.find((one) => one.joint === joint)?.intervals ?? [];
}

function column({ positions, frames }: SolvedMotion, joint: number, axis: number): Float64Array {
  return Float64Array.from({ length: frames }, (_, t) => positions[(t * JOINT_COUNT + joint) * 3 + axis]!);
}

/** The motion raised or lowered evenly, so that toes are at height 0 while they stand. */
function onGround(motion: SolvedMotion, stances: readonly Stances[]): SolvedMotion {
  const { frames } = motion;
  const heights = TOES.map((joint) => column(motion, joint, 1));
  const lowest = Float64Array.from({ length: frames }, (_, t) => Math.min(...heights.map((one) => one[t]!)));
  const typical = percentile(lowest, 30);
  const diagonal = new Float64Array(frames).fill(HEIGHT_WEIGHT);
  const right = new Float64Array(frames).fill(HEIGHT_WEIGHT * typical);
  TOES.forEach((joint, i) => {
    for (const { first, last } of contactsOf(stances)(joint))
      for (let t = first; t <= last; t++) {
        diagonal[t]! += 1;
        right[t]! += heights[i]![t]!;
      }
  });
  return lowered(motion, solveEven(diagonal, right, EVEN_WEIGHT));
}
