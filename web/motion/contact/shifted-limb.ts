import type { SolvedMotion } from '../skeleton/clip';
import { between, conjugate, multiply, type Quat, readQuat, rotate, writeQuat } from '../math/quat';
import { type LegJoints, LEGS, type LimbJoints } from '../skeleton/limbs';
import { JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import { add, direction, length, readVec, sub, type Vec3, writeVec, X_AXIS } from '../math/vec3';
import { type Limb, twoBoneIk } from './two-bone-ik';

/** The bones of a limb in a frame of positions (frames x 22 x 3, metres). */
export function bonesAt(
  positions: Float32Array,
  { start, middle, end }: LimbJoints,
  frame: number,
): Omit<Limb, 'hinge'> {
  const row = frame * JOINT_COUNT;
  const from = readVec(positions, row + start);
  const bend = readVec(positions, row + middle);
  return { start: from, upper: sub(bend, from), lower: sub(readVec(positions, row + end), bend) };
}

/** Rotations and joints that are written. */
type Written = Pick<SolvedMotion, 'rotations' | 'positions'>;

/**
 * Writes a limb of a frame with its end shifted as far as asked, by two-bone inverse kinematics; what follows the end is
 * left.
 * @param shift metres
 * @returns rotations of the lower bone in world axes, before and with the shift, and where the end is
 */
export function shiftEnd(
  motion: SolvedMotion,
  limb: LimbJoints,
  frame: number,
  shift: Vec3,
  written: Written,
): { before: Quat; lower: Quat; end: Vec3 } {
  const { start, middle, end, hinge } = limb;
  const row = frame * JOINT_COUNT;
  const parent = worldRotation(motion.rotations, row, PARENTS[start]!);
  const first = multiply(parent, readQuat(motion.rotations, row + start));
  const before = multiply(first, readQuat(motion.rotations, row + middle));
  const bones = bonesAt(motion.positions, limb, frame);
  const turns = twoBoneIk(
    { start: bones.start, upper: bones.upper, lower: bones.lower, hinge: rotate(first, hinge) },
    add(readVec(motion.positions, row + end), shift),
  );
  const upper = multiply(turns.upper, first);
  const lower = multiply(turns.lower, before);
  writeQuat(written.rotations, row + start, multiply(conjugate(parent), upper));
  writeQuat(written.rotations, row + middle, multiply(conjugate(upper), lower));
  const bend = placeJoint(motion, row, middle, bones.start, upper, written);
  return { before, lower, end: placeJoint(motion, row, end, bend, lower, written) };
}

/**
 * Writes one leg of one frame with its foot shifted: the ankle goes as far as asked, and the foot turns the shortest way
 * to where the toe would be.
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
  const { before, lower, end } = shiftEnd(motion, leg, frame, shift.ankle, written);
  const standing = multiply(before, readQuat(motion.rotations, row + leg.end));
  const sole = rotate(standing, readVec(motion.offsets, leg.toe));
  const foot = multiply(
    between(direction(sole, X_AXIS), direction(add(sole, sub(shift.toe, shift.ankle)), X_AXIS)),
    standing,
  );
  writeQuat(written.rotations, row + leg.end, multiply(conjugate(lower), foot));
  placeJoint(motion, row, leg.toe, end, foot, written);
}

/** A shorter shift is left out, metres: it would not be seen. */
const LEAST_SHIFT = 1e-5;

/** How far a foot is shifted along each axis, up by nothing unless it says so: metres, one a frame. */
export interface FootShift {
  readonly x: Float64Array;
  readonly y?: Float64Array;
  readonly z: Float64Array;
}

/**
 * The motion with both feet shifted, ankle and toe alike, so that they keep their rotations; thigh and shin follow by
 * two-bone inverse kinematics, and nothing else moves. Pure.
 * @param shiftOf a leg, 0 for the left and 1 for the right
 */
export function withShiftedFeet(
  motion: SolvedMotion,
  shiftOf: (leg: LegJoints, side: number) => FootShift,
): SolvedMotion {
  const rotations = motion.rotations.slice();
  const positions = motion.positions.slice();
  LEGS.forEach((leg, side) => {
    const { x, y, z } = shiftOf(leg, side);
    for (let frame = 0; frame < motion.frames; frame++) {
      const shift: Vec3 = [x[frame]!, y?.[frame] ?? 0, z[frame]!];
      if (length(shift) < LEAST_SHIFT) continue;
      shiftFoot(motion, leg, frame, { ankle: shift, toe: shift }, { rotations, positions });
    }
  });
  return { ...motion, rotations, positions };
}

/** Writes where a joint is, from its parent's place and rotation in world axes. @returns it, metres */
function placeJoint(
  { offsets }: SolvedMotion,
  row: number,
  joint: number,
  parent: Vec3,
  turn: Quat,
  written: Written,
): Vec3 {
  const to = add(parent, rotate(turn, readVec(offsets, joint)));
  writeVec(written.positions, row + joint, to);
  return to;
}

/** The rotation of a joint in world axes. @param row that of the frame's first joint */
function worldRotation(rotations: Float32Array, row: number, joint: number): Quat {
  const own = readQuat(rotations, row + joint);
  return joint === 0 ? own : multiply(worldRotation(rotations, row, PARENTS[joint]!), own);
}
