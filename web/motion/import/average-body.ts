import type { JointName } from '../skeleton/skeleton';
import { type Vec3, ZERO } from '../math/vec3';

/**
 * An average adult of 1.70 m for formats that hold angles alone: offset of each of the 22 joints from its parent in the
 * T-pose facing +z, metres.
 *
 * Lengths of limbs and heights of hips, shoulders and neck are the shares of stature of Drillis and Contini (Body segment
 * parameters, 1966); the upper arm is counted from the centre of the shoulder joint, and pelvis and spine divide the way
 * from hips to neck as retarget.ts does.
 */
export const AVERAGE_BODY: Readonly<Record<JointName, Vec3>> = {
  pelvis: ZERO,
  left_hip: [0.085, -0.095, 0],
  right_hip: [-0.085, -0.095, 0],
  spine1: [0, 0.117, 0],
  left_knee: [0, -0.417, 0],
  right_knee: [0, -0.417, 0],
  spine2: [0, 0.111, 0],
  left_ankle: [0, -0.418, 0],
  right_ankle: [0, -0.418, 0],
  spine3: [0, 0.059, 0],
  left_foot: [0, -0.045, 0.12],
  right_foot: [0, -0.045, 0.12],
  neck: [0, 0.148, 0],
  left_collar: [0.07, 0.09, 0],
  right_collar: [-0.07, 0.09, 0],
  head: [0, 0.1, 0],
  left_shoulder: [0.13, 0.01, 0],
  right_shoulder: [-0.13, 0.01, 0],
  left_elbow: [0.28, 0, 0],
  right_elbow: [-0.28, 0, 0],
  left_wrist: [0.248, 0, 0],
  right_wrist: [-0.248, 0, 0],
};
