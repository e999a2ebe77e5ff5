import type { Vec3 } from '../math/vec3';
import { J } from './skeleton';

/** The joints of a leg or an arm. */
export interface LimbJoints {
  /** Hip, knee and ankle, or shoulder, elbow and wrist. */
  readonly start: number;
  readonly middle: number;
  readonly end: number;
  /** Unit axis about which the limb bends in the rest pose, a T-pose facing +z. */
  readonly hinge: Vec3;
}

export interface LegJoints extends LimbJoints {
  readonly toe: number;
}

/** Left and right. */
export const LEGS: readonly LegJoints[] = [
  { start: J.left_hip, middle: J.left_knee, end: J.left_ankle, toe: J.left_foot, hinge: [1, 0, 0] },
  { start: J.right_hip, middle: J.right_knee, end: J.right_ankle, toe: J.right_foot, hinge: [1, 0, 0] },
];
export const ARMS: readonly LimbJoints[] = [
  { start: J.left_shoulder, middle: J.left_elbow, end: J.left_wrist, hinge: [0, -1, 0] },
  { start: J.right_shoulder, middle: J.right_elbow, end: J.right_wrist, hinge: [0, 1, 0] },
];
