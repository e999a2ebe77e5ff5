import {
  aboutAxis,
  between,
  conjugate,
  multiply,
  type Quat,
  readQuat,
  rotate,
  writeQuat,
} from '../math/quat';
import { add, cross, direction, dot, length, readVec, sub, type Vec3, writeVec } from '../math/vec3';
import type { SolvedMotion } from '../skeleton/clip';
import type { LimbJoints } from '../skeleton/limbs';
import { JOINT_COUNT, PARENTS } from '../skeleton/skeleton';

/**
 * Largest length of a limb that is asked for, as a share of its bones' lengths. Near a straight limb a millimetre at its
 * end would move the knee or elbow by centimetres.
 */
const MAX_EXTENSION = 0.985;

/** A leg or an arm as two bones, in world axes. */
export interface Limb {
  /** Hip or shoulder. */
  readonly start: Vec3;
  /** Vectors from there to the knee or elbow, and on to the ankle or wrist, metres. */
  readonly upper: Vec3;
  readonly lower: Vec3;
  /** Unit axis through the knee or elbow, perpendicular to the upper bone, about which the limb bends. */
  readonly hinge: Vec3;
}

/**
 * Two-bone inverse kinematics, solved analytically by the law of cosines (Tolani, Goswami and Badler, Real-time inverse
 * kinematics techniques for anthropomorphic limbs, 2000): the rotations that bring the end of a limb to `target` with its
 * start and the bone lengths kept. Both are in world axes, to be applied to the bones as they are.
 *
 * The limb first bends about its hinge until its length is the distance to the target. Then the whole limb turns by the
 * shortest arc onto the target, so that knee or elbow keeps its direction. With the end as target both rotations are the
 * identity. Where the target is too far, the limb points at it fully stretched.
 */
export function twoBoneIk({ start, upper, lower, hinge }: Limb, target: Vec3): { upper: Quat; lower: Quat } {
  const toTarget = sub(target, start);
  // |upper + turned lower|^2 = |upper|^2 + |lower|^2 + 2 (c cos + s sin) of the angle, largest with a straight limb.
  const along = dot(hinge, lower);
  const c = dot(upper, lower) - along * dot(hinge, upper);
  const s = dot(upper, cross(hinge, lower));
  const product = (dot(toTarget, toTarget) - dot(upper, upper) - dot(lower, lower)) / 2;
  const angle = Math.acos(Math.max(-1, Math.min(1, product / Math.sqrt(c * c + s * s))));
  // The difference to the present bend, without its sign: a knee that noise has bent forwards passes through the
  // straight leg without a jump.
  const bend = aboutAxis(hinge, angle - Math.abs(Math.atan2(s, c)));
  const bent = add(upper, rotate(bend, lower));
  const swing = between(direction(bent, toTarget), direction(toTarget, bent));
  return { upper: swing, lower: multiply(swing, bend) };
}

/** The largest length that a limb may have, metres: nearly straight, or its present length if longer. */
export function maxLimbLength(upper: Vec3, lower: Vec3): number {
  return Math.max(length(add(upper, lower)), MAX_EXTENSION * (length(upper) + length(lower)));
}

/** The bones of a limb in a frame of positions (frames x 22 x 3, metres). */
export function bonesAt(
  positions: Float32Array,
  { start, middle, end }: LimbJoints,
  frame: number,
): Omit<Limb, 'hinge'> {
  const row = frame * JOINT_COUNT;
  const from = readVec(positions, row + start);
  const between = readVec(positions, row + middle);
  return { start: from, upper: sub(between, from), lower: sub(readVec(positions, row + end), between) };
}

/** Rotations and joints that are written. */
export type Written = Pick<SolvedMotion, 'rotations' | 'positions'>;

/**
 * Writes a limb of a frame with its end shifted as far as asked; what follows the end is left.
 * @param shift metres
 * @returns the rotation of the lower bone in world axes, and where the end is
 */
export function shiftEnd(
  motion: SolvedMotion,
  limb: LimbJoints,
  frame: number,
  shift: Vec3,
  written: Written,
): { lower: Quat; end: Vec3 } {
  const { start, middle, end, hinge } = limb;
  const row = frame * JOINT_COUNT;
  const parent = worldRotation(motion.rotations, row, PARENTS[start]!);
  const before = multiply(parent, readQuat(motion.rotations, row + start));
  const bones = bonesAt(motion.positions, limb, frame);
  const turns = twoBoneIk(
    { start: bones.start, upper: bones.upper, lower: bones.lower, hinge: rotate(before, hinge) },
    add(readVec(motion.positions, row + end), shift),
  );
  const upper = multiply(turns.upper, before);
  const lower = multiply(turns.lower, multiply(before, readQuat(motion.rotations, row + middle)));
  writeQuat(written.rotations, row + start, multiply(conjugate(parent), upper));
  writeQuat(written.rotations, row + middle, multiply(conjugate(upper), lower));
  const place = placeJoint(motion, row, middle, bones.start, upper, written);
  return { lower, end: placeJoint(motion, row, end, place, lower, written) };
}

/** Writes where a joint is, from its parent's place and rotation in world axes. @returns it, metres */
export function placeJoint(
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
export function worldRotation(rotations: Float32Array, row: number, joint: number): Quat {
  const own = readQuat(rotations, row + joint);
  return joint === 0 ? own : multiply(worldRotation(rotations, row, PARENTS[joint]!), own);
}
