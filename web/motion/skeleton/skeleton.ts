/** The 22 joints of the SMPL body in its own order: the only skeleton past the readers. */
export const SMPL22 = [
  'pelvis',
  'left_hip',
  'right_hip',
  'spine1',
  'left_knee',
  'right_knee',
  'spine2',
  'left_ankle',
  'right_ankle',
  'spine3',
  'left_foot',
  'right_foot',
  'neck',
  'left_collar',
  'right_collar',
  'head',
  'left_shoulder',
  'right_shoulder',
  'left_elbow',
  'right_elbow',
  'left_wrist',
  'right_wrist',
] as const;

export type JointName = (typeof SMPL22)[number];

export const JOINT_COUNT = SMPL22.length;

/** Index of each joint by name, so that code reads `J.left_knee` instead of 4. */
export const J = Object.fromEntries(SMPL22.map((name, index) => [name, index])) as Readonly<
  Record<JointName, number>
>;

/** Parent of every joint, -1 for the root. A parent always comes before its children. */
export const PARENTS: readonly number[] = [
  -1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19,
];

export const SIDES = ['left', 'right'] as const;
export type Side = (typeof SIDES)[number];

/** The joint on the other side of the body; one in the middle is its own. */
export const otherSide = (joint: JointName): JointName =>
  joint.replace(/^(left|right)/, (side) => (side === 'left' ? 'right' : 'left')) as JointName;

/** The same by index. */
export const MIRROR: readonly number[] = SMPL22.map((joint) => J[otherSide(joint)]);

/** Ankles and toes, the joints that stand on the floor. */
export const FEET: readonly number[] = [J.left_ankle, J.right_ankle, J.left_foot, J.right_foot];

/** Children of every joint, in joint order. */
export const CHILDREN: readonly (readonly number[])[] = SMPL22.map((_, joint) =>
  PARENTS.flatMap((parent, child) => (parent === joint ? [child] : [])),
);
