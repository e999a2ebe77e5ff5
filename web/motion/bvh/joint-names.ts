import type { JointName } from '../skeleton/skeleton';

/**
 * Names that our BVH files give the 22 joints: those of MotionBuilder's HumanIK, which Blender add-ons, Maya,
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
