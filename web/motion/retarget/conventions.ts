/** Joints of one side of the body, from the trunk outwards. */
export const LIMB_JOINTS = ['hip', 'knee', 'ankle', 'toe', 'shoulder', 'elbow', 'wrist', 'collar'] as const;
export type LimbJoint = (typeof LIMB_JOINTS)[number];

/**
 * Skeleton convention: the joint names that a family of programs uses.
 *
 * Names are compared in lower case without prefix, namespace, spaces and punctuation, whatever the script; `*` stands
 * for the side.
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
    // Humanoid bones of Unity and VRM; VRoid writes J_Bip_L_UpperLeg.
    name: 'VRM / Unity',
    sides: [...SIDE_WORDS, ...SIDE_LETTERS],
    limbs: {
      hip: ['*upperleg', 'jbip*upperleg'],
      knee: ['*lowerleg', 'jbip*lowerleg'],
      ankle: ['*foot', 'jbip*foot'],
      toe: ['*toes', '*toebase', 'jbip*toebase', '*toe'],
      shoulder: ['*upperarm', 'jbip*upperarm'],
      elbow: ['*lowerarm', 'jbip*lowerarm'],
      wrist: ['*hand', 'jbip*hand'],
      collar: ['*shoulder', 'jbip*shoulder'],
    },
    // Without what all of VRoid's names begin with a `c` for the middle is left.
    neck: ['neck', 'jbipcneck', 'cneck'],
    head: ['head', 'jbipchead', 'chead'],
  },
  {
    // Unreal's mannequin.
    name: 'Unreal',
    sides: SIDE_LETTERS,
    limbs: {
      hip: ['thigh*'],
      knee: ['calf*'],
      ankle: ['foot*'],
      toe: ['ball*'],
      shoulder: ['upperarm*'],
      elbow: ['lowerarm*'],
      wrist: ['hand*'],
      collar: ['clavicle*'],
    },
    neck: ['neck01'],
    head: ['head'],
  },
  {
    // Deform bones of Blender's Rigify, and its metarig.
    name: 'Rigify',
    sides: SIDE_LETTERS,
    limbs: {
      hip: ['thigh*'],
      knee: ['shin*'],
      ankle: ['foot*'],
      toe: ['toe*'],
      shoulder: ['upperarm*'],
      elbow: ['forearm*'],
      wrist: ['hand*'],
      collar: ['shoulder*'],
    },
    neck: ['spine004', 'neck'],
    head: ['spine006', 'head'],
  },
  {
    // The default rig of MakeHuman, whose long bones have two halves.
    name: 'MakeHuman',
    sides: SIDE_LETTERS,
    limbs: {
      hip: ['upperleg01*'],
      knee: ['lowerleg01*'],
      ankle: ['foot*'],
      toe: ['toe11*', 'toe21*'],
      shoulder: ['upperarm01*'],
      elbow: ['lowerarm01*'],
      wrist: ['wrist*'],
      collar: ['clavicle*'],
    },
    neck: ['neck01'],
    head: ['head'],
  },
  {
    name: 'SOMA',
    sides: SIDE_WORDS,
    limbs: { ...HUMAN_IK.limbs, hip: ['*leg'], knee: ['*shin'] },
    neck: ['neck1'],
    head: ['head'],
  },
  {
    // Marker-based skeletons of OptiTrack Motive.
    name: 'OptiTrack',
    sides: SIDE_LETTERS,
    limbs: {
      hip: ['*thigh'],
      knee: ['*shin'],
      ankle: ['*foot'],
      toe: ['*toe'],
      shoulder: ['*uarm'],
      elbow: ['*farm'],
      wrist: ['*hand'],
      collar: ['*shoulder'],
    },
    neck: ['neck'],
    head: ['head'],
  },
  {
    name: 'Rokoko',
    sides: SIDE_WORDS,
    limbs: { ...HUMAN_IK.limbs, hip: ['*thigh'], knee: ['*shin'], toe: ['*toe', '*toebase'] },
    neck: ['neck'],
    head: ['head'],
  },
  {
    // Segments of Xsens MVN in FBX.
    name: 'Xsens',
    sides: SIDE_WORDS,
    limbs: {
      hip: ['*upperleg'],
      knee: ['*lowerleg'],
      ankle: ['*foot'],
      toe: ['*toe'],
      shoulder: ['*upperarm'],
      elbow: ['*forearm'],
      wrist: ['*hand'],
      collar: ['*shoulder'],
    },
    neck: ['neck'],
    head: ['head'],
  },
  {
    // Joints of Xsens MVN in BVH, and of the first BVH files: the shoulder is the shoulder, not the collar.
    name: 'Xsens',
    sides: SIDE_WORDS,
    limbs: {
      hip: ['*hip'],
      knee: ['*knee'],
      ankle: ['*ankle'],
      toe: ['*toe', '*foot'],
      shoulder: ['*shoulder'],
      elbow: ['*elbow'],
      wrist: ['*wrist'],
      collar: ['*collar'],
    },
    neck: ['neck'],
    head: ['head'],
  },
  {
    // Bones of ASF skeletons; a joint is where its bone begins.
    name: 'CMU (ASF)',
    sides: SIDE_LETTERS,
    limbs: {
      hip: ['*femur'],
      knee: ['*tibia'],
      ankle: ['*foot'],
      toe: ['*toes'],
      shoulder: ['*humerus'],
      elbow: ['*radius'],
      wrist: ['*wrist'],
      collar: ['*clavicle'],
    },
    neck: ['lowerneck'],
    head: ['head'],
  },
  {
    name: 'MMD',
    sides: [['左', '右']],
    limbs: {
      hip: ['*足'],
      knee: ['*ひざ'],
      ankle: ['*足首'],
      toe: ['*つま先', '*足先ex'],
      shoulder: ['*腕'],
      elbow: ['*ひじ'],
      wrist: ['*手首'],
      collar: ['*肩'],
    },
    neck: ['首'],
    head: ['頭'],
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
        '*loleg',
        'loleg*',
        '*leg',
        'leg*',
        '*knee',
        'knee*',
      ],
      ankle: ['*ankle', 'ankle*', '*foot', 'foot*'],
      toe: ['*toebase', '*toe', 'toe*', '*toes', 'toes*', '*ball', 'ball*', '*foot', 'foot*'],
      shoulder: ['*upperarm', 'upperarm*', '*uparm', 'uparm*', '*arm', 'arm*', '*shoulder', 'shoulder*'],
      elbow: [
        '*forearm',
        'forearm*',
        '*lowerarm',
        'lowerarm*',
        '*lowarm',
        '*loarm',
        'loarm*',
        '*elbow',
        'elbow*',
      ],
      wrist: ['*wrist', 'wrist*', '*hand', 'hand*'],
      collar: ['*collar', 'collar*', '*clavicle', 'clavicle*', '*shoulder', 'shoulder*'],
    },
    neck: ['neck', 'neck1', 'neck01', 'necklower', 'spine004'],
    head: ['head', 'spine006'],
  },
];
