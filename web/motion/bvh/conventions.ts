import { BVH_NAMES } from './joint-names';

/** Joints of one side of the body, from the trunk outwards. */
export const LIMB_JOINTS = ['hip', 'knee', 'ankle', 'toe', 'shoulder', 'elbow', 'wrist', 'collar'] as const;
export type LimbJoint = (typeof LIMB_JOINTS)[number];

/**
 * How a family of programs names the joints.
 *
 * Names are compared in lower case without prefix, namespace, spaces and punctuation; `*` stands for the side.
 */
export interface Dialect {
  readonly name: string;
  /** What every joint's name begins with, where the family has such a mark. */
  readonly prefix?: RegExp;
  /** Ways to write left and right. */
  readonly sides: readonly (readonly [string, string])[];
  readonly limbs: Readonly<Record<LimbJoint, readonly string[]>>;
  readonly neck: readonly string[];
  readonly head: readonly string[];
  /** Names of pelvis, spine1, spine2 and spine3 where the family has the very joints of our skeleton. */
  readonly trunk?: readonly [string, string, string, string];
}

const WORDS = [['left', 'right']] as const;
const LETTERS = [['l', 'r']] as const;

const HUMAN_IK = {
  sides: WORDS,
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

/** 3ds Max and its heirs. */
const BIPED = {
  sides: LETTERS,
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

/** Known families, the more particular first; the last one tries every usual word. */
export const DIALECTS: readonly Dialect[] = [
  { name: 'Mixamo', prefix: /^mixamorig\d*[:_]?/i, ...HUMAN_IK },
  { name: 'Character Creator', prefix: /^cc_base_/i, ...BIPED },
  { name: 'Biped', prefix: /^(valvebiped[._])?bip\d+[ _-]?/i, ...BIPED },
  {
    name: 'SMPL',
    sides: [...WORDS, ...LETTERS],
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
    sides: LETTERS,
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
    sides: [...WORDS, ...LETTERS],
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

/** A file of our own is known by having our 22 joints and no other. */
export const OWN_DIALECT = 'ReactDance';

export function isOwn(names: readonly string[]): boolean {
  const ours = Object.values(BVH_NAMES);
  return names.length === ours.length && ours.every((name) => names.includes(name));
}
