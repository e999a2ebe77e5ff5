import type { Matrix4 } from 'three';
import { SOLE } from '../../motion/skeleton/kinematics';
import type { LegJoints } from '../../motion/skeleton/limbs';

/** Height of the sole under the ball of a foot, metres; `joints` are 22 x 3, metres. */
export const ballHeight = (joints: Float32Array, { toe }: LegJoints): number => joints[toe * 3 + 1]! - SOLE;

/**
 * Height of the sole under a heel, metres.
 *
 * @param joints 22 x 3, metres
 * @param offsets of the skeleton at rest, 22 x 3, metres
 */
export const heelHeight = (
  joints: Float32Array,
  offsets: Float32Array,
  { end: ankle, toe }: LegJoints,
): number => joints[ankle * 3 + 1]! + offsets[toe * 3 + 1]! - SOLE;

/**
 * Placement of something that lies on the floor under a foot, in the direction of the foot, written to `out`.
 *
 * @param joints 22 x 3, metres
 * @param ahead of the ankle, as a share of the way to the toe joint
 * @param above height over the floor, so that it does not intersect what lies there already, metres
 */
export function footMatrix(
  joints: Float32Array,
  { end: ankle, toe }: LegJoints,
  ahead: number,
  above: number,
  out: Matrix4,
): Matrix4 {
  const between = (axis: number): number => {
    const from = joints[ankle * 3 + axis]!;
    return from + (joints[toe * 3 + axis]! - from) * ahead;
  };
  const along = (axis: number): number => joints[toe * 3 + axis]! - joints[ankle * 3 + axis]!;
  return out.makeRotationY(Math.atan2(along(0), along(2))).setPosition(between(0), above, between(2));
}
