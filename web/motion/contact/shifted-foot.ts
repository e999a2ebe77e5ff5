import type { SolvedMotion } from '../skeleton/clip';
import { bonesAt, twoBoneIk } from './two-bone-ik';
import { between, conjugate, multiply, type Quat, readQuat, rotate, writeQuat } from '../math/quat';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { add, direction, readVec, sub, type Vec3, writeVec, X_AXIS } from '../math/vec3';

/** Joint indices of a leg. */
export interface LegJoints {
  readonly hip: number;
  readonly knee: number;
  readonly ankle: number;
  readonly toe: number;
}

export const LEGS: readonly LegJoints[] = [
  { hip: J.left_hip, knee: J.left_knee, ankle: J.left_ankle, toe: J.left_foot },
  { hip: J.right_hip, knee: J.right_knee, ankle: J.right_ankle, toe: J.right_foot },
];

/**
 * Writes one leg of one frame with its foot shifted: the ankle goes as far as asked, by two-bone inverse kinematics, and
 * the foot turns the shortest way to where the toe would be.
 * @param shift of ankle and toe, metres; a foot whose shifts are the same keeps its rotation
 */
export function shiftFoot(
  motion: SolvedMotion,
  joints: LegJoints,
  frame: number,
  shift: { readonly ankle: Vec3; readonly toe: Vec3 },
  shifted: Pick<SolvedMotion, 'rotations' | 'positions'>,
): void {
  const { hip, knee, ankle, toe } = joints;
  const row = frame * JOINT_COUNT;
  const turnOf = (joint: number): Quat => readQuat(motion.rotations, row + joint);
  const pelvis = turnOf(J.pelvis);
  const thigh = multiply(pelvis, turnOf(hip));
  const shin = multiply(thigh, turnOf(knee));
  const before = multiply(shin, turnOf(ankle));
  const sole = rotate(before, readVec(motion.offsets, toe));
  const foot = multiply(
    between(direction(sole, X_AXIS), direction(add(sole, sub(shift.toe, shift.ankle)), X_AXIS)),
    before,
  );
  // In the rest pose knees bend about x.
  const leg = { ...bonesAt(motion.positions, frame, [hip, knee, ankle]), hinge: rotate(thigh, X_AXIS) };
  const turns = twoBoneIk(leg, add(readVec(motion.positions, row + ankle), shift.ankle));
  const [upper, lower] = [multiply(turns.upper, thigh), multiply(turns.lower, shin)];
  const put = (joint: number, parent: Quat, turn: Quat): void =>
    writeQuat(shifted.rotations, row + joint, multiply(conjugate(parent), turn));
  put(hip, pelvis, upper);
  put(knee, upper, lower);
  put(ankle, lower, foot);
  const place = (joint: number, from: Vec3, turn: Quat): Vec3 => {
    const to = add(from, rotate(turn, readVec(motion.offsets, joint)));
    writeVec(shifted.positions, row + joint, to);
    return to;
  };
  place(toe, place(ankle, place(knee, leg.start, upper), lower), foot);
}
