import { readQuat, slerp, writeQuat } from '../math/quat';
import { fitRotation, type RigidPart, rigidPart } from '../math/rigid';
import { addScaled, directionTo, rotateRow } from '../math/rows';
import { direction, length, readVec, writeVec, Y_AXIS } from '../math/vec3';
import { ARMS, LEGS } from '../skeleton/limbs';
import { J, JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import type { SteadyTrunk, TrunkRotations } from './trunk';

/** A motion on the skeleton of constant bone lengths. */
export interface Poses extends TrunkRotations {
  /** frames x 22 x 3, metres. */
  readonly joints: Float64Array;
}

/** Rest skeleton, one row a joint: the offset from its parent, and that offset's direction and length, metres. */
export interface Bones {
  readonly offsets: Float64Array;
  readonly directions: Float64Array;
  readonly lengths: readonly number[];
}

export function bonesOf(restOffsets: Float32Array): Bones {
  const offsets = new Float64Array(restOffsets);
  const directions = new Float64Array(offsets.length);
  PARENTS.forEach((_, joint) => writeVec(directions, joint, direction(readVec(offsets, joint), Y_AXIS)));
  return { offsets, directions, lengths: PARENTS.map((_, joint) => length(readVec(offsets, joint))) };
}

/** A rigid part of the trunk: the rotation that turns it, the joint at its origin, and its other joints. */
interface TrunkPart {
  readonly part: keyof TrunkRotations;
  readonly origin: number;
  readonly joints: readonly number[];
}

const PELVIS: TrunkPart = { part: 'pelvis', origin: J.pelvis, joints: [J.left_hip, J.right_hip, J.spine1] };
const CHEST: TrunkPart = { part: 'chest', origin: J.spine3, joints: [J.neck, J.left_collar, J.right_collar] };

const SPINE = [J.spine2, J.spine3];
/** Joints whose bones turn with the pelvis where they show no direction; the others turn with the chest. */
const CARRIED_BY_PELVIS: ReadonlySet<number> = new Set([
  ...SPINE,
  ...LEGS.flatMap(({ start, middle, end, toe }) => [start, middle, end, toe]),
]);

/** Sweeps of `fitLimb`; each halves what the bone lengths leave of the error at the end of the limb. */
const LIMB_SWEEPS = 3;
/** Passes that move the root by the mean error of the joints. */
const ROOT_PASSES = 2;

/** One frame of a fit, and working memory that is the same for all frames. */
interface Frame {
  /** 22 x 3: where the joints are seen, and where they are placed, metres. */
  readonly observed: Float64Array;
  readonly joints: Float64Array;
  /** Rotations of the trunk, one row each: to start from with one number of certainty, and as fitted. */
  readonly start: SteadyTrunk;
  readonly pelvis: Float64Array;
  readonly chest: Float64Array;
  /** 22 x 3: directions of bones whose ends are seen at one place, those of the rest pose turned with the trunk. */
  readonly fallbacks: Float64Array;
  readonly bones: Bones;
  readonly parts: Readonly<Record<keyof TrunkRotations, RigidPart>>;
  readonly vectors: Float64Array;
}

/** Places a joint at its bone's length from its parent, in the direction of a row of `target`. */
function aim({ joints, fallbacks, bones }: Frame, joint: number, target: Float64Array, j: number): void {
  const parent = PARENTS[joint]!;
  directionTo(joints, joint, joints, parent, target, j, fallbacks, joint);
  addScaled(joints, joint, joints, parent, joints, joint, bones.lengths[joint]!);
}

function follow(frame: Frame, joint: number): void {
  aim(frame, joint, frame.observed, joint);
}

/**
 * Places the two bones of a limb, so that both its middle joint (knee, elbow) and its end are near the observed ones.
 *
 * Sweeps as in FABRIK (Aristidou and Lasenby 2011): place the middle from the end, take the mean with the observed one,
 * restore the upper bone's length. An exact solution for the end would be worse: near a straight limb a millimetre at
 * the end moves the knee by centimetres.
 */
function fitLimb(frame: Frame, middle: number, end: number): void {
  const { observed, joints, fallbacks, bones, vectors } = frame;
  follow(frame, middle);
  for (let sweep = 0; sweep < LIMB_SWEEPS; sweep++) {
    directionTo(vectors, 0, joints, middle, observed, end, fallbacks, end);
    addScaled(vectors, 0, observed, end, vectors, 0, -bones.lengths[end]!);
    for (let axis = 0; axis < 3; axis++) vectors[axis] = (vectors[axis]! + observed[3 * middle + axis]!) / 2;
    aim(frame, middle, vectors, 0);
  }
  follow(frame, end);
}

/** Turns a rigid part of the trunk onto the observed joints, as far as they show its rotation, and places its joints. */
function fitPart(frame: Frame, { part, origin, joints: members }: TrunkPart): void {
  const { observed, joints, bones, parts, vectors } = frame;
  const rotation = frame[part];
  for (let i = 0; i < members.length; i++) addScaled(vectors, i, observed, members[i]!, joints, origin, -1);
  rotation.set(frame.start[part]);
  fitRotation(rotation, parts[part], vectors);
  const certainty = frame.start.certainty[part][0]!;
  if (certainty < 1) {
    writeQuat(rotation, 0, slerp(readQuat(frame.start[part], 0), readQuat(rotation, 0), certainty));
  }
  for (const joint of members) {
    rotateRow(joints, joint, rotation, 0, bones.offsets, joint);
    addScaled(joints, joint, joints, origin, joints, joint, 1);
  }
}

/** Fits all joints, given where the root is. */
function fitFromRoot(frame: Frame): void {
  fitPart(frame, PELVIS);
  for (const joint of SPINE) follow(frame, joint);
  fitPart(frame, CHEST);
  follow(frame, J.head);
  for (const { middle, end, toe } of LEGS) {
    fitLimb(frame, middle, end);
    follow(frame, toe);
  }
  for (const { start, middle, end } of ARMS) {
    follow(frame, start);
    fitLimb(frame, middle, end);
  }
}

/** Moves the root by the mean error of the joints. */
function moveRoot({ observed, joints, vectors }: Frame): void {
  vectors.fill(0);
  for (let joint = 0; joint < JOINT_COUNT; joint++) {
    addScaled(vectors, 0, vectors, 0, observed, joint, 1);
    addScaled(vectors, 0, vectors, 0, joints, joint, -1);
  }
  addScaled(joints, J.pelvis, joints, J.pelvis, vectors, 0, 1 / JOINT_COUNT);
}

/**
 * The poses on constant bones that are nearest to the observed joints, frame by frame.
 *
 * @param observed frames x 22 x 3, metres
 * @param start rotations of the trunk to start from
 */
export function fitPoses(observed: Float64Array, bones: Bones, start: SteadyTrunk): Poses {
  const poses = { joints: observed.slice(), pelvis: start.pelvis.slice(), chest: start.chest.slice() };
  const rigid = ({ joints }: TrunkPart): RigidPart =>
    rigidPart(joints.map((joint) => readVec(bones.offsets, joint)));
  const parts = { pelvis: rigid(PELVIS), chest: rigid(CHEST) };
  const fallbacks = new Float64Array(3 * JOINT_COUNT);
  const vectors = new Float64Array(9);
  const row = (rows: Float64Array, t: number, size: number): Float64Array =>
    rows.subarray(t * size, (t + 1) * size);
  for (let t = 0; t < start.pelvis.length / 4; t++) {
    const frame = {
      observed: row(observed, t, fallbacks.length),
      joints: row(poses.joints, t, fallbacks.length),
      pelvis: row(poses.pelvis, t, 4),
      chest: row(poses.chest, t, 4),
      fallbacks,
      bones,
      start: {
        pelvis: row(start.pelvis, t, 4),
        chest: row(start.chest, t, 4),
        certainty: { pelvis: row(start.certainty.pelvis, t, 1), chest: row(start.certainty.chest, t, 1) },
      },
      parts,
      vectors,
    };
    for (let joint = 1; joint < JOINT_COUNT; joint++) {
      const carrier = CARRIED_BY_PELVIS.has(joint) ? frame.pelvis : frame.chest;
      rotateRow(fallbacks, joint, carrier, 0, bones.directions, joint);
    }
    fitFromRoot(frame);
    for (let pass = 0; pass < ROOT_PASSES; pass++) {
      moveRoot(frame);
      fitFromRoot(frame);
    }
  }
  return poses;
}
