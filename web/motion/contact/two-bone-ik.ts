import { aboutAxis, between, multiply, type Quat, rotate } from '../math/quat';
import { add, cross, direction, dot, length, sub, type Vec3 } from '../math/vec3';

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
