import { cross, direction, type Vec3, Y_AXIS, Z_AXIS } from '../math/vec3';
import { J } from './skeleton';

const PAIRS = [
  [J.left_hip, J.right_hip],
  [J.left_shoulder, J.right_shoulder],
] as const;

/** Heading of a dancer, radians about y (0 is +z), from hips and shoulders (22 x 3, metres). */
export function headingOf(joints: ArrayLike<number>): number {
  let [x, z] = [0, 0];
  for (const [left, right] of PAIRS) {
    x += joints[left * 3]! - joints[right * 3]!;
    z += joints[left * 3 + 2]! - joints[right * 3 + 2]!;
  }
  return Math.atan2(-z, x);
}

/** The same as a unit vector level with the floor, from the vector from a right joint to its left one. */
export function forwardOf(rightToLeft: Vec3): Vec3 {
  return direction(cross(rightToLeft, Y_AXIS), Z_AXIS);
}
