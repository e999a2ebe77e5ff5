import type { SolvedMotion } from '../skeleton/clip';
import { between, conjugate, multiply, rotate, writeQuat } from '../math/quat';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { add, direction, readVec, sub, type Vec3, X_AXIS } from '../math/vec3';
import { type LimbJoints, placeJoint, shiftEnd, worldRotation, type Written } from './two-bone-ik';

/** The joints of a leg: hip, knee, ankle and toe. */
export interface LegJoints extends LimbJoints {
  readonly toe: number;
}

// In the rest pose knees bend about x.
export const LEGS: readonly LegJoints[] = [
  { start: J.left_hip, middle: J.left_knee, end: J.left_ankle, toe: J.left_foot, hinge: X_AXIS },
  { start: J.right_hip, middle: J.right_knee, end: J.right_ankle, toe: J.right_foot, hinge: X_AXIS },
];

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
