import { aboutAxisInto, betweenInto, multiplyInto, rotateInto } from '../math/flat-quaternions';
import { addInto, crossInto, directionInto, dotAt, lengthAt, subtractInto } from '../math/flat-vectors';

/**
 * Largest length of a leg that is asked for, as a share of its bones' lengths. Near a straight leg a millimetre at the
 * ankle would move the knee by centimetres.
 */
const MAX_EXTENSION = 0.985;

/**
 * A leg as two bones in world axes is a row of numbers: the position of the hip; the vectors hip to knee and knee to
 * ankle, metres; and the unit axis through the knee, perpendicular to the thigh, about which the shin bends backwards.
 */
export const LEG = { hip: 0, thigh: 3, shin: 6, hinge: 9, size: 12 } as const;

/** Working memory of the functions below; nothing is kept from call to call. */
const toTarget = new Float64Array(3);
const bent = new Float64Array(3);
const from = new Float64Array(3);
const to = new Float64Array(3);

/**
 * Two-bone inverse kinematics, solved analytically by the law of cosines (Tolani, Goswami and Badler, Real-time inverse
 * kinematics techniques for anthropomorphic limbs, 2000): the rotations that bring the ankle to a target with the hip
 * and the bone lengths kept, in world axes, to be applied to the bones as they are.
 *
 * The knee first bends about its hinge until the leg's length is the distance from hip to target. Then the whole leg
 * turns by the shortest arc onto the target, so that the knee keeps its direction. With the ankle as target both
 * rotations are the identity. Where the target is too far, the leg points at it fully stretched.
 *
 * @param turns 2 x 4, the rotations of thigh and shin, is written
 * @param legs with `l`: an array and where a leg begins
 * @param target position, metres
 */
export function twoBoneIk(turns: Float64Array, legs: Float64Array, l: number, target: Float64Array): void {
  const [thigh, shin, hinge] = [l + LEG.thigh, l + LEG.shin, l + LEG.hinge];
  subtractInto(toTarget, 0, target, 0, legs, l + LEG.hip);
  // |thigh + turned shin|^2 = |thigh|^2 + |shin|^2 + 2 (c cos + s sin) of the angle, largest with a straight knee.
  const c = dotAt(legs, thigh, legs, shin) - dotAt(legs, hinge, legs, shin) * dotAt(legs, hinge, legs, thigh);
  crossInto(bent, 0, legs, hinge, legs, shin);
  const s = dotAt(legs, thigh, bent, 0);
  const squares = dotAt(toTarget, 0, toTarget, 0) - dotAt(legs, thigh, legs, thigh) - dotAt(legs, shin, legs, shin);
  const angle = Math.acos(Math.max(-1, Math.min(1, squares / 2 / Math.sqrt(c * c + s * s))));
  // The difference to the present bend, without its sign: a knee that noise has bent forwards passes through the
  // straight leg without a jump.
  aboutAxisInto(turns, 4, legs, hinge, angle - Math.abs(Math.atan2(s, c)));
  rotateInto(bent, 0, turns, 4, legs, shin);
  addInto(bent, 0, bent, 0, legs, thigh);
  directionInto(from, 0, bent, 0, toTarget, 0);
  directionInto(to, 0, toTarget, 0, bent, 0);
  betweenInto(turns, 0, from, 0, to, 0);
  multiplyInto(turns, 4, turns, 0, turns, 4);
}

/** The largest distance from hip to ankle that a leg may have, metres: nearly straight, or its present length if longer. */
export function maxLegLength(legs: Float64Array, l: number): number {
  addInto(bent, 0, legs, l + LEG.thigh, legs, l + LEG.shin);
  const stretched = lengthAt(legs, l + LEG.thigh) + lengthAt(legs, l + LEG.shin);
  return Math.max(lengthAt(bent, 0), MAX_EXTENSION * stretched);
}
