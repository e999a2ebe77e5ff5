import { refuseTooFew } from '../retarget/length';
import { type MotionSource, restOf, type SourceJoint } from '../retarget/source';
import { PARENTS, SMPL22 } from '../skeleton/skeleton';

/** Joints over time without rotations, as many formats hold them. */
export interface Positions {
  readonly joints: readonly SourceJoint[];
  /** frames x joints x 3, in world axes. */
  readonly places: Float32Array;
}

/** The 22 joints by their own names. */
export const SMPL_JOINTS: readonly SourceJoint[] = SMPL22.map((name, joint) => ({
  name,
  parent: PARENTS[joint]!,
}));

/** Things of several dancers, the leader's first; else in the order of the file. */
export function leaderFirst<T>(things: readonly T[], nameOf: (thing: T) => string): T[] {
  const isLeader = (thing: T): number => Number(/leader|lead$/i.test(nameOf(thing)));
  return things.toSorted((a, b) => isLeader(b) - isLeader(a));
}

/** What a reader knows about a file beside its positions. */
export type About = Pick<MotionSource, 'format' | 'frameRate' | 'rateAssumed' | 'unit' | 'upAxis'> &
  Partial<Pick<MotionSource, 'convention' | 'parts' | 'part' | 'warnings'>>;

/**
 * A source of positions: every joint is moved from its parent, and none turns.
 *
 * @throws {AppError} `too-few-frames`
 */
export function sourceOfPositions({ joints, places }: Positions, about: About): MotionSource {
  const width = joints.length * 3;
  const frames = places.length / width;
  refuseTooFew(frames);
  const localPoses = (wanted: readonly number[]) => {
    const translations = new Float32Array(wanted.length * width);
    wanted.forEach((frame, place) => {
      joints.forEach(({ parent }, joint) => {
        for (let axis = 0; axis < 3; axis++) {
          const at = (index: number): number => places[frame * width + index * 3 + axis]!;
          translations[place * width + joint * 3 + axis] = at(joint) - (parent < 0 ? 0 : at(parent));
        }
      });
    });
    return restOf(translations);
  };
  return {
    parts: [],
    part: 0,
    warnings: [],
    truncated: false,
    ...about,
    joints,
    rest: localPoses([0]),
    frames,
    localPoses,
  };
}

/** The body's joints of NVIDIA's SOMA skeleton, with their parents. */
const SOMA_PARENTS: readonly (readonly [string, string | null])[] = [
  ['Hips', null],
  ['Spine1', 'Hips'],
  ['Spine2', 'Spine1'],
  ['Chest', 'Spine2'],
  ['Neck1', 'Chest'],
  ['Neck2', 'Neck1'],
  ['Head', 'Neck2'],
  ...['Left', 'Right'].flatMap((side): [string, string][] => [
    [`${side}Shoulder`, 'Chest'],
    [`${side}Arm`, `${side}Shoulder`],
    [`${side}ForeArm`, `${side}Arm`],
    [`${side}Hand`, `${side}ForeArm`],
  ]),
  ...['Left', 'Right'].flatMap((side): [string, string][] => [
    [`${side}Leg`, 'Hips'],
    [`${side}Shin`, `${side}Leg`],
    [`${side}Foot`, `${side}Shin`],
    [`${side}ToeBase`, `${side}Foot`],
  ]),
];

/** Where the body's joints are among those of a skeleton with fingers and a face, by the number of all its joints. */
const SKELETONS: ReadonlyMap<
  number,
  { readonly joints: readonly SourceJoint[]; readonly at: readonly number[] }
> = new Map([
  // SMPL, SMPL-H, SMPL-X, and SMPL-X with its landmarks: the body comes first.
  ...[22, 24, 52, 55, 127, 144].map(
    (count) => [count, { joints: SMPL_JOINTS, at: [...SMPL22.keys()] }] as const,
  ),
  ...(
    [
      [77, [11, 39, 67, 72]],
      [30, [10, 16, 22, 26]],
    ] as const
  ).map(([count, limbs]) => {
    const names = SOMA_PARENTS.map(([name]) => name);
    const joints = SOMA_PARENTS.map(([name, parent]) => ({
      name,
      parent: parent === null ? -1 : names.indexOf(parent),
    }));
    const at = [0, 1, 2, 3, 4, 5, 6, ...limbs.flatMap((first) => [0, 1, 2, 3].map((step) => first + step))];
    return [count, { joints, at }] as const;
  }),
]);

/**
 * The body in an array of all joints of a known skeleton, recognised by their number: 22, 24, 52, 55, 127 or 144 (SMPL
 * and its kin), 77 or 30 (SOMA). Null for another number.
 *
 * @param values frames x count x 3
 */
export function bodyOf(values: ArrayLike<number>, count: number): Positions | null {
  const skeleton = SKELETONS.get(count);
  if (!skeleton) return null;
  const { joints, at } = skeleton;
  const frames = values.length / (3 * count);
  const places = new Float32Array(frames * joints.length * 3);
  for (let frame = 0; frame < frames; frame++)
    at.forEach((from, to) => {
      for (let axis = 0; axis < 3; axis++)
        places[(frame * joints.length + to) * 3 + axis] = values[(frame * count + from) * 3 + axis]!;
    });
  return { joints, places };
}

/** The numbers of joints that `bodyOf` knows. */
export const JOINT_COUNTS: readonly number[] = [...SKELETONS.keys()];
