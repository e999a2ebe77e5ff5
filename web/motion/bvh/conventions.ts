import type { JointName } from '../skeleton/skeleton';

/** Joints of one side of the body, from the trunk outwards. */
export const LIMB_JOINTS = ['hip', 'knee', 'ankle', 'toe', 'shoulder', 'elbow', 'wrist', 'collar'] as const;
export type LimbJoint = (typeof LIMB_JOINTS)[number];

/**
 * Skeleton convention: the joint names that a family of programs uses.
 *
 * Names are compared in lower case without prefix, namespace, spaces and punctuation; `*` stands for the side.
 */
export interface SkeletonConvention {
  readonly name: string;
  /** Beginning of every joint's name, where the convention has one. */
  readonly prefix?: RegExp;
  /** Words for left and right. */
  readonly sides: readonly (readonly [string, string])[];
  readonly limbs: Readonly<Record<LimbJoint, readonly string[]>>;
  readonly neck: readonly string[];
  readonly head: readonly string[];
  /** Names of pelvis, spine1, spine2 and spine3 where the convention has exactly the joints of the SMPL skeleton. */
  readonly trunk?: readonly [string, string, string, string];
}

const SIDE_WORDS = [['left', 'right']] as const;
const SIDE_LETTERS = [['l', 'r']] as const;

const HUMAN_IK = {
  sides: SIDE_WORDS,
  limbs: {
    hip: ['*upleg'],
    knee: ['*leg'],
    ankle: ['*foot'],
    toe: ['*toebase', '*toe'],
    shoulder: ['*arm'],
    elbow: ['*forearm'],
    wrist: ['*hand'],
    collar: ['*shoulder'],
  },
  neck: ['neck'],
  head: ['head'],
} as const;

/** The biped of 3ds Max, and conventions derived from it. */
const BIPED = {
  sides: SIDE_LETTERS,
  limbs: {
    hip: ['*thigh'],
    knee: ['*calf'],
    ankle: ['*foot'],
    toe: ['*toebase', '*toe0', '*toe'],
    shoulder: ['*upperarm'],
    elbow: ['*forearm'],
    wrist: ['*hand'],
    collar: ['*clavicle'],
  },
  neck: ['neck', 'necktwist01'],
  head: ['head'],
} as const;

/** Known conventions, the more specific first; the last one tries every common name. */
export const CONVENTIONS: readonly SkeletonConvention[] = [
  { name: 'Mixamo', prefix: /^mixamorig\d*[:_]?/i, ...HUMAN_IK },
  { name: 'Character Creator', prefix: /^cc_base_/i, ...BIPED },
  { name: 'Biped', prefix: /^(valvebiped[._])?bip\d+[ _-]?/i, ...BIPED },
  {
    name: 'SMPL',
    sides: [...SIDE_WORDS, ...SIDE_LETTERS],
    limbs: {
      hip: ['*hip'],
      knee: ['*knee'],
      ankle: ['*ankle'],
      toe: ['*foot'],
      shoulder: ['*shoulder'],
      elbow: ['*elbow'],
      wrist: ['*wrist'],
      collar: ['*collar'],
    },
    neck: ['neck'],
    head: ['head'],
    trunk: ['pelvis', 'spine1', 'spine2', 'spine3'],
  },
  { name: 'CMU / MotionBuilder', ...HUMAN_IK },
  {
    name: 'DAZ',
    sides: SIDE_LETTERS,
    limbs: {
      hip: ['*thigh', '*thighbend'],
      knee: ['*shin'],
      ankle: ['*foot'],
      toe: ['*toe', '*toes'],
      shoulder: ['*shldr', '*shldrbend', '*upperarm'],
      elbow: ['*forearm', '*forearmbend'],
      wrist: ['*hand'],
      collar: ['*collar', '*shoulder'],
    },
    neck: ['neck', 'necklower', 'neck1'],
    head: ['head'],
  },
  {
    name: 'generic names',
    sides: [...SIDE_WORDS, ...SIDE_LETTERS],
    limbs: {
      hip: ['*thigh', 'thigh*', '*upleg', 'upleg*', '*upperleg', 'upperleg*', '*hip', 'hip*'],
      knee: [
        '*shin',
        'shin*',
        '*calf',
        'calf*',
        '*lowerleg',
        'lowerleg*',
        '*lowleg',
        '*leg',
        'leg*',
        '*knee',
        'knee*',
      ],
      ankle: ['*ankle', 'ankle*', '*foot', 'foot*'],
      toe: ['*toebase', '*toe', 'toe*', '*toes', 'toes*', '*ball', 'ball*', '*foot', 'foot*'],
      shoulder: ['*upperarm', 'upperarm*', '*uparm', 'uparm*', '*arm', 'arm*', '*shoulder', 'shoulder*'],
      elbow: ['*forearm', 'forearm*', '*lowerarm', 'lowerarm*', '*lowarm', '*elbow', 'elbow*'],
      wrist: ['*wrist', 'wrist*', '*hand', 'hand*'],
      collar: ['*collar', 'collar*', '*clavicle', 'clavicle*', '*shoulder', 'shoulder*'],
    },
    neck: ['neck', 'neck1', 'neck01', 'necklower', 'spine004'],
    head: ['head', 'spine006'],
  },
];

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
