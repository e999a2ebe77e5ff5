import type { Matrix4 } from 'three';
import { J } from '../../motion/skeleton/skeleton';
import { SOLE } from '../../motion/skeleton/kinematics';

interface Foot {
  readonly ankle: number;
  readonly toe: number;
}

export const FEET: readonly Foot[] = [
  { ankle: J.left_ankle, toe: J.left_foot },
  { ankle: J.right_ankle, toe: J.right_foot },
];

/**
 * Placement of something that lies on the floor under a foot, in the direction of the foot, written to `out`.
 *
 * @param joints 22 x 3, metres
 * @param above height over the floor, so that it does not intersect what lies there already, metres
 */
export function footMatrix(joints: Float32Array, { ankle, toe }: Foot, above: number, out: Matrix4): Matrix4 {
  const at = (joint: number, axis: number): number => joints[joint * 3 + axis]!;
  const angle = Math.atan2(at(toe, 0) - at(ankle, 0), at(toe, 2) - at(ankle, 2));
  return out
    .makeRotationY(angle)
    .setPosition(
      (at(toe, 0) + at(ankle, 0)) / 2 + Math.sin(angle) * 0.02,
      -SOLE + above,
      (at(toe, 2) + at(ankle, 2)) / 2 + Math.cos(angle) * 0.02,
    );
}
