import type { SolvedMotion } from '../skeleton/clip';
import { between, conjugate, multiply, rotate, writeQuat } from '../math/quat';
import type { LegJoints } from '../skeleton/limbs';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { add, direction, readVec, sub, type Vec3, X_AXIS } from '../math/vec3';
import { placeJoint, shiftEnd, worldRotation, type Written } from './two-bone-ik';

/**
 * Writes one leg of one frame with its foot shifted: the ankle goes as far as asked, by two-bone inverse kinematics, and
 * the foot turns the shortest way to where the toe would be.
 * @param shift of ankle and toe, metres; a foot whose shifts are the same keeps its rotation
 */
export function shiftFoot(
  motion: SolvedMotion,
  leg: LegJoints,
  frame: number,
  shift: { readonly ankle: Vec3; readonly toe: Vec3 },
  written: Written,
): void {
  const row = frame * JOINT_COUNT;
  const before = worldRotation(motion.rotations, row, leg.end);
  const sole = rotate(before, readVec(motion.offsets, leg.toe));
  const foot = multiply(
    between(direction(sole, X_AXIS), direction(add(sole, sub(shift.toe, shift.ankle)), X_AXIS)),
    before,
  );
  const { lower, end } = shiftEnd(motion, leg, frame, shift.ankle, written);
  writeQuat(written.rotations, row + leg.end, multiply(conjugate(lower), foot));
  placeJoint(motion, row, leg.toe, end, foot, written);
}
