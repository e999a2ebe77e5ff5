import { J, JOINT_COUNT, PARENTS } from '../../motion/skeleton/skeleton';
import type { Vec3 } from './field';

/** Where the joints are while the body is meshed and bound: a relaxed A instead of the skeleton's T. */
export interface BindPose {
  /** 22 joint positions in metres, pelvis at the origin. */
  readonly joints: readonly Vec3[];
  /** Rotation of each joint about z, radians, against the rest pose. */
  readonly turns: readonly number[];
}

/** Arms hang and legs part in most dance poses: binding there halves how far the skin must stretch. */
const ARM_DOWN = 1;
const LEG_OUT = 0.1;

const OWN_TURN: Readonly<Record<number, number>> = {
  [J.left_shoulder]: -ARM_DOWN,
  [J.right_shoulder]: ARM_DOWN,
  [J.left_hip]: LEG_OUT,
  [J.right_hip]: -LEG_OUT,
  // Feet stay flat on the floor.
  [J.left_ankle]: -LEG_OUT,
  [J.right_ankle]: LEG_OUT,
};

/**
 * Joint positions and rotations of the pose the body is modelled in.
 *
 * @param offsets 22 x 3 rest offsets from the parent in metres, T-pose facing +z.
 */
export function bindPose(offsets: ArrayLike<number>): BindPose {
  const joints: Vec3[] = [];
  const turns: number[] = [];
  for (let joint = 0; joint < JOINT_COUNT; joint++) {
    const parent = PARENTS[joint]!;
    if (parent < 0) {
      joints.push([0, 0, 0]);
      turns.push(0);
      continue;
    }
    const turn = turns[parent]!;
    const [x, y, z] = [offsets[joint * 3]!, offsets[joint * 3 + 1]!, offsets[joint * 3 + 2]!];
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    const origin = joints[parent]!;
    joints.push([origin[0] + cos * x - sin * y, origin[1] + sin * x + cos * y, origin[2] + z]);
    turns.push(turn + (OWN_TURN[joint] ?? 0));
  }
  return { joints, turns };
}
