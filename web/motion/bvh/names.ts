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

/** Name of the convention of files that `writeBvh` wrote. */
export const OWN_CONVENTION = 'ReactDance';

/** Whether these are the names of a file that `writeBvh` wrote: exactly the 22 of `BVH_NAMES`. */
export function isOwnSkeleton(names: readonly string[]): boolean {
  const own = Object.values(BVH_NAMES);
  return names.length === own.length && own.every((name) => names.includes(name));
}
