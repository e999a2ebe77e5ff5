import { J } from './skeleton';

const PAIRS = [
  [J.left_hip, J.right_hip],
  [J.left_shoulder, J.right_shoulder],
] as const;

/** Where a dancer faces, radians about y (0 is +z), from hips and shoulders (22 x 3, metres). */
export function headingOf(joints: ArrayLike<number>): number {
  let [x, z] = [0, 0];
  for (const [left, right] of PAIRS) {
    x += joints[left * 3]! - joints[right * 3]!;
    z += joints[left * 3 + 2]! - joints[right * 3 + 2]!;
  }
  return Math.atan2(-z, x);
}
