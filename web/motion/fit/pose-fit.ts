import { rotateInto } from '../math/flat-quaternions';
import { addInto, AXES, copyInto, directionInto, lengthAt, subtractInto } from '../math/flat-vectors';
import { fitRotation, type RigidPart, rigidPart } from '../math/rigid';
import { J, JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import type { TrunkRotations } from './rest-pose';

/** A motion on the skeleton of constant bone lengths, in world axes. */
export interface Poses {
  /** frames x 22 x 3, metres. */
  readonly joints: Float64Array;
  readonly trunk: TrunkRotations;
}

/** Rest skeleton, one row a joint: the offset from its parent, and that offset's length (metres) and direction. */
export interface Bones {
  readonly offsets: Float64Array;
  readonly lengths: Float64Array;
  readonly directions: Float64Array;
}

export function bonesOf(restOffsets: Float32Array): Bones {
  const offsets = new Float64Array(restOffsets);
  const directions = new Float64Array(offsets.length);
  for (let i = 0; i < offsets.length; i += 3) directionInto(directions, i, offsets, i, AXES, 3);
  const lengths = Float64Array.from(PARENTS, (_, joint) => lengthAt(offsets, 3 * joint));
  return { offsets, lengths, directions };
}

/** The joints of a rigid part of the trunk, as vectors from its origin. */
interface TrunkPart {
  readonly origin: number;
  readonly joints: readonly number[];
  readonly rigid: RigidPart;
}

const PELVIS_JOINTS = [J.left_hip, J.right_hip, J.spine1];
const CHEST_JOINTS = [J.neck, J.left_collar, J.right_collar];

/** Joints that follow the observed ones bone by bone, between pelvis and chest. */
const SPINE = [J.spine2, J.spine3];
/** The same beyond the chest. */
const BEYOND_CHEST = [J.head, J.left_shoulder, J.right_shoulder];

const LIMBS = [
  { middle: J.left_knee, end: J.left_ankle, toe: J.left_foot },
  { middle: J.right_knee, end: J.right_ankle, toe: J.right_foot },
  { middle: J.left_elbow, end: J.left_wrist, toe: null },
  { middle: J.right_elbow, end: J.right_wrist, toe: null },
] as const;
const CARRIED_BY_PELVIS: ReadonlySet<number> = new Set([
  ...SPINE,
  ...LIMBS.flatMap(({ middle, end, toe }) => (toe === null ? [] : [middle, end, toe])),
]);

/** Sweeps of `fitLimb`; each halves what the bone lengths leave of the error at the end of the limb. */
const LIMB_SWEEPS = 3;
/** Passes that move the root by the mean error of the joints. */
const ROOT_PASSES = 2;

const ROW = 3 * JOINT_COUNT;

/** What all frames of a fit share: its inputs, its result and working memory. */
interface Fit {
  readonly observed: Float64Array;
  readonly bones: Bones;
  /** Rotations that every pass starts from. */
  readonly start: TrunkRotations;
  readonly pelvis: TrunkPart;
  readonly chest: TrunkPart;
  readonly poses: Poses;
  /** Directions of all bones of one frame where the observed ones have none: those of rest, turned with the trunk. */
  readonly fallbacks: Float64Array;
  readonly vectors: Float64Array;
}

/** Places a joint of the frame at `row` at its bone's length from `from`, in the direction of `towards`. */
function aim(
  { bones, poses: { joints }, fallbacks, vectors }: Fit,
  row: number,
  joint: number,
  from: Float64Array,
  i: number,
  towards: Float64Array,
  j: number,
): void {
  subtractInto(vectors, 0, towards, j, from, i);
  directionInto(vectors, 0, vectors, 0, fallbacks, 3 * joint);
  addInto(joints, row + 3 * joint, from, i, vectors, 0, bones.lengths[joint]!);
}

/** Places a joint at its bone's length from its parent, in the direction of the observed joint. */
function follow(fit: Fit, row: number, joint: number): void {
  aim(fit, row, joint, fit.poses.joints, row + 3 * PARENTS[joint]!, fit.observed, row + 3 * joint);
}

/**
 * Middle joint of a two-bone limb (knee, elbow), so that both it and the end are near the observed ones.
 *
 * Sweeps as in FABRIK (Aristidou and Lasenby 2011): place the middle from the end, take the mean with the observed one,
 * restore the upper bone's length. An exact solution for the end would be worse: near a straight limb a millimetre at
 * the end moves the knee by centimetres.
 */
function fitLimb(fit: Fit, row: number, middle: number, end: number): void {
  const { observed, bones, fallbacks, vectors } = fit;
  const { joints } = fit.poses;
  const at = row + 3 * middle;
  const start = row + 3 * PARENTS[middle]!;
  aim(fit, row, middle, joints, start, observed, at);
  for (let sweep = 0; sweep < LIMB_SWEEPS; sweep++) {
    // The direction from the middle to the end, as the fallback is given for that.
    subtractInto(vectors, 0, observed, row + 3 * end, joints, at);
    directionInto(vectors, 0, vectors, 0, fallbacks, 3 * end);
    addInto(vectors, 3, observed, row + 3 * end, vectors, 0, -bones.lengths[end]!);
    addInto(vectors, 3, vectors, 3, observed, at, 1);
    for (let axis = 3; axis < 6; axis++) vectors[axis]! /= 2;
    aim(fit, row, middle, joints, start, vectors, 3);
  }
}

/** Turns a rigid part of the trunk onto the observed joints and places its joints. */
function fitPart(
  { observed, bones, poses: { joints }, vectors }: Fit,
  frame: number,
  { origin, joints: part, rigid }: TrunkPart,
  start: Float64Array,
  rotations: Float64Array,
): void {
  const [row, turn] = [ROW * frame, 4 * frame];
  const from = row + 3 * origin;
  for (let i = 0; i < part.length; i++)
    subtractInto(vectors, 3 * i, observed, row + 3 * part[i]!, joints, from);
  for (let i = turn; i < turn + 4; i++) rotations[i] = start[i]!;
  fitRotation(rotations, turn, rigid, vectors);
  for (let i = 0; i < part.length; i++) {
    rotateInto(vectors, 0, rotations, turn, bones.offsets, 3 * part[i]!);
    addInto(joints, row + 3 * part[i]!, joints, from, vectors, 0);
  }
}

/** Fits all joints of a frame, given where its root is. */
function fitFrom(fit: Fit, frame: number): void {
  const row = frame * ROW;
  const { start } = fit;
  const { trunk } = fit.poses;
  fitPart(fit, frame, fit.pelvis, start.pelvis, trunk.pelvis);
  for (const joint of SPINE) follow(fit, row, joint);
  fitPart(fit, frame, fit.chest, start.chest, trunk.chest);
  for (const joint of BEYOND_CHEST) follow(fit, row, joint);
  for (const { middle, end, toe } of LIMBS) {
    fitLimb(fit, row, middle, end);
    follow(fit, row, end);
    if (toe !== null) follow(fit, row, toe);
  }
}

/** Moves the root of the frame at `row` by the mean error of the joints. */
function moveRoot({ observed, poses: { joints }, vectors }: Fit, row: number): void {
  vectors.fill(0, 0, 3);
  for (let i = row; i < row + ROW; i += 3) {
    addInto(vectors, 0, vectors, 0, observed, i);
    addInto(vectors, 0, vectors, 0, joints, i, -1);
  }
  addInto(joints, row, joints, row, vectors, 0, 1 / JOINT_COUNT);
}

/**
 * The poses on constant bones that are nearest to the observed joints, frame by frame.
 *
 * @param observed frames x 22 x 3, metres
 * @param start rotations of the trunk to start from
 */
export function fitPoses(observed: Float64Array, bones: Bones, start: TrunkRotations): Poses {
  const partOf = (origin: number, joints: readonly number[]): TrunkPart => ({
    origin,
    joints,
    rigid: rigidPart(
      Float64Array.from(joints.flatMap((joint) => [...bones.offsets.subarray(3 * joint, 3 * joint + 3)])),
    ),
  });
  const trunk = {
    pelvis: new Float64Array(start.pelvis.length),
    chest: new Float64Array(start.chest.length),
  };
  const poses = { joints: new Float64Array(observed.length), trunk };
  const fallbacks = new Float64Array(ROW);
  const fit: Fit = {
    observed,
    bones,
    start,
    pelvis: partOf(J.pelvis, PELVIS_JOINTS),
    chest: partOf(J.spine3, CHEST_JOINTS),
    poses,
    fallbacks,
    vectors: new Float64Array(9),
  };
  for (let frame = 0; frame < observed.length / ROW; frame++) {
    const row = frame * ROW;
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const carrier = CARRIED_BY_PELVIS.has(joint) ? start.pelvis : start.chest;
      rotateInto(fallbacks, 3 * joint, carrier, 4 * frame, bones.directions, 3 * joint);
    }
    copyInto(poses.joints, row, observed, row);
    fitFrom(fit, frame);
    for (let pass = 0; pass < ROOT_PASSES; pass++) {
      moveRoot(fit, row);
      fitFrom(fit, frame);
    }
  }
  return poses;
}
