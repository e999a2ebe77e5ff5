import { type Side, SIDES } from '../../motion/skeleton/skeleton';

/** Landmarks of MediaPipe Pose that are used, by name. */
export const L = {
  nose: 0,
  left_ear: 7,
  right_ear: 8,
  left_shoulder: 11,
  right_shoulder: 12,
  left_elbow: 13,
  right_elbow: 14,
  left_wrist: 15,
  right_wrist: 16,
  left_hip: 23,
  right_hip: 24,
  left_knee: 25,
  right_knee: 26,
  left_ankle: 27,
  right_ankle: 28,
  left_heel: 29,
  right_heel: 30,
  left_toe: 31,
  right_toe: 32,
} as const;

/** The landmark on the other side of the body. */
export const OTHER_SIDE: readonly number[] = [
  0, 4, 5, 6, 1, 2, 3, 8, 7, 10, 9, 12, 11, 14, 13, 16, 15, 18, 17, 20, 19, 22, 21, 24, 23, 26, 25, 28, 27,
  30, 29, 32, 31,
];

/** Landmarks of trunk and limbs, which carry the pose; hands and face are of little use. */
export const BODY: readonly number[] = [11, 12, 13, 14, 15, 16, 23, 24, 25, 26, 27, 28, 31, 32];

/** Lines that draw a body: pairs of landmarks, and the side that they belong to. */
export const BONES: readonly {
  readonly from: number;
  readonly to: number;
  readonly side: Side | 'middle';
}[] = [
  { from: L.left_shoulder, to: L.right_shoulder, side: 'middle' },
  { from: L.left_hip, to: L.right_hip, side: 'middle' },
  ...SIDES.flatMap((side) =>
    (
      [
        ['shoulder', 'elbow'],
        ['elbow', 'wrist'],
        ['shoulder', 'hip'],
        ['hip', 'knee'],
        ['knee', 'ankle'],
        ['ankle', 'toe'],
      ] as const
    ).map(([from, to]) => ({ from: L[`${side}_${from}`], to: L[`${side}_${to}`], side })),
  ),
];
