import type { SolvedMotion } from '../skeleton/clip';
import { SOLE } from '../skeleton/kinematics';
import { gaussianFilter, windowMaximum } from '../math/statistics';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { shiftFoot } from './shifted-limb';
import { LEGS } from '../skeleton/limbs';

/** Standard deviation of the way up and down again, seconds. */
const SMOOTHING = 0.06;

/**
 * The lift that brings a joint of the foot out of the floor, metres a frame.
 * @param height of the joint above the floor in a standing foot, metres
 */
function liftOf({ positions, frames, fps }: SolvedMotion, joint: number, height: number): Float64Array {
  const under = Float64Array.from({ length: frames }, (_, frame) =>
    Math.max(0, height - positions[(frame * JOINT_COUNT + joint) * 3 + 1]!),
  );
  if (!under.some(Boolean)) return under;
  return gaussianFilter(windowMaximum(under, Math.round(SMOOTHING * fps)), SMOOTHING * fps);
}

/**
 * Brings heels and balls of the feet out of the floor, each by what it is under it: a foot whose heel alone is under the
 * floor turns about its ball. Legs follow by two-bone inverse kinematics; nothing else moves. Pure.
 * @param toeRest height of the toes of a standing foot, metres: above a floor at height 0 by the thickness of a sole
 */
export function liftFeet(motion: SolvedMotion, toeRest = SOLE): SolvedMotion {
  const rotations = motion.rotations.slice();
  const positions = motion.positions.slice();
  for (const joints of LEGS) {
    const ankles = liftOf(motion, joints.end, toeRest - motion.offsets[joints.toe * 3 + 1]!);
    const toes = liftOf(motion, joints.toe, toeRest);
    for (let frame = 0; frame < motion.frames; frame++) {
      const [ankle, toe] = [ankles[frame]!, toes[frame]!];
      if (ankle > 0 || toe > 0)
        shiftFoot(
          motion,
          joints,
          frame,
          { ankle: [0, ankle, 0], toe: [0, toe, 0] },
          { rotations, positions },
        );
    }
  }
  return { ...motion, rotations, positions };
}
