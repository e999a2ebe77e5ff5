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

/** Whether these are the names of a file that this page wrote: exactly the 22 of `BVH_NAMES`, and in BVH the reference. */
export function isOwnSkeleton(names: readonly string[]): boolean {
  const own = Object.values(BVH_NAMES);
  const joints = names.filter((name) => name !== REFERENCE);
  return joints.length === own.length && own.every((name) => joints.includes(name));
}
