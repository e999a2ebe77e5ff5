import { J, JOINT_COUNT, PARENTS } from '../../motion/skeleton/skeleton';
import type { Vec3 } from '../../motion/math/vec3';

/** Joints of the pose in which the body is meshed and bound: an A-pose instead of the skeleton's T-pose. */
export interface BindPose {
  /** 22 joint positions in metres, pelvis at the origin. */
  readonly joints: readonly Vec3[];
  /** Rotation of each joint about z, radians, against the rest pose. */
  readonly turns: readonly number[];
}

/** Rotations from the T-pose, radians. In most dance poses arms hang: this halves how far the skin must stretch. */
const ARM_DOWN = 1;
const LEG_OUT = 0.1;

const JOINT_TURNS: Readonly<Record<number, number>> = {
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
    turns.push(turn + (JOINT_TURNS[joint] ?? 0));
  }
  return { joints, turns };
}
