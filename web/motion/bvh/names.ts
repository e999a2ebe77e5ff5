import type { JointName } from '../skeleton/skeleton';

/**
 * Names of the 22 joints in files that `writeBvh` writes: those of MotionBuilder's HumanIK, which Blender add-ons, Maya,
 * MotionBuilder and game engines recognise without a mapping by hand.
 */
export const BVH_NAMES: Readonly<Record<JointName, string>> = {
  pelvis: 'Hips',
  left_hip: 'LeftUpLeg',
  right_hip: 'RightUpLeg',
  spine1: 'Spine',
  left_knee: 'LeftLeg',
  right_knee: 'RightLeg',
  spine2: 'Spine1',
  left_ankle: 'LeftFoot',
  right_ankle: 'RightFoot',
  spine3: 'Spine2',
  left_foot: 'LeftToeBase',
  right_foot: 'RightToeBase',
  neck: 'Neck',
  left_collar: 'LeftShoulder',
  right_collar: 'RightShoulder',
  head: 'Head',
  left_shoulder: 'LeftArm',
  right_shoulder: 'RightArm',
  left_elbow: 'LeftForeArm',
  right_elbow: 'RightForeArm',
  left_wrist: 'LeftHand',
  right_wrist: 'RightHand',
};

/** Name of the point below the hips on which the body of a BVH file hangs, also as HumanIK calls it. */
export const REFERENCE = 'Reference';

/** Name of the convention of files that `writeBvh` wrote. */
export const OWN_CONVENTION = 'ReactDance';

/** Names of the armatures above the hips in GLB files. */
export const ARMATURES = { leader: 'Leader', reactor: 'Reactor' };

const ABOVE_HIPS: readonly string[] = [REFERENCE, ...Object.values(ARMATURES)];

/** Whether these are the names of one dancer in a file that this page wrote: those of `BVH_NAMES`, and one above them. */
export function isOwnSkeleton(names: readonly string[]): boolean {
  const own = Object.values(BVH_NAMES);
  const joints = names.filter((name) => !ABOVE_HIPS.includes(name));
  return joints.length === own.length && own.every((name) => joints.includes(name));
}
