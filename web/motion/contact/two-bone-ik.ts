import { aboutAxis, between, multiply, type Quat, rotate } from '../math/quat';
import { add, cross, direction, dot, length, sub, type Vec3 } from '../math/vec3';

/**
 * Largest length of a leg that is asked for, as a share of its bones' lengths. Near a straight leg a millimetre at the
 * ankle would move the knee by centimetres.
 */
const MAX_EXTENSION = 0.985;

/** A leg as two bones, in world axes. */
export interface Leg {
  readonly hip: Vec3;
  /** Vectors hip to knee and knee to ankle, metres. */
  readonly thigh: Vec3;
  readonly shin: Vec3;
  /** Unit axis through the knee, perpendicular to the thigh, about which the shin bends backwards. */
  readonly hinge: Vec3;
}

/**
 * Two-bone inverse kinematics, solved analytically by the law of cosines (Tolani, Goswami and Badler, Real-time inverse
 * kinematics techniques for anthropomorphic limbs, 2000): the rotations that bring the ankle to `target` with the hip
 * and the bone lengths kept. `thigh` and `shin` are rotations in world axes, to be applied to the bones as they are.
 *
 * The knee first bends about its hinge until the leg's length is the distance from hip to target. Then the whole leg
 * turns by the shortest arc onto the target, so that the knee keeps its direction. With the ankle as target both
 * rotations are the identity. Where the target is too far, the leg points at it fully stretched.
 */
export function twoBoneIk(leg: Leg, target: Vec3): { thigh: Quat; shin: Quat } {
  const { hip, thigh, shin, hinge } = leg;
  const toTarget = sub(target, hip);
  // |thigh + turned shin|^2 = |thigh|^2 + |shin|^2 + 2 (c cos + s sin) of the angle, largest with a straight knee.
  const along = dot(hinge, shin);
  const c = dot(thigh, shin) - along * dot(hinge, thigh);
  const s = dot(thigh, cross(hinge, shin));
  const product = (dot(toTarget, toTarget) - dot(thigh, thigh) - dot(shin, shin)) / 2;
  const angle = Math.acos(Math.max(-1, Math.min(1, product / Math.sqrt(c * c + s * s))));
  // The difference to the present bend, without its sign: a knee that noise has bent forwards passes through the
  // straight leg without a jump.
  const bend = aboutAxis(hinge, angle - Math.abs(Math.atan2(s, c)));
  const bentLeg = add(thigh, rotate(bend, shin));
  const swing = between(direction(bentLeg, toTarget), direction(toTarget, bentLeg));
  return { thigh: swing, shin: multiply(swing, bend) };
}

/** The largest distance from hip to ankle that a leg may have, metres: nearly straight, or its present length if longer. */
export function maxLegLength(thigh: Vec3, shin: Vec3): number {
  return Math.max(length(add(thigh, shin)), MAX_EXTENSION * (length(thigh) + length(shin)));
}
