import {
  betweenInto,
  fromAxesInto,
  multiplyInto,
  rotateInto,
  rotateInverseInto,
  slerpInto,
} from '../math/flat-quaternions';
import { addInto, crossInto, directionInto, subtractInto } from '../math/flat-vectors';
import type { Bones, Poses } from './pose-fit';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { smoothHinges } from './twist';

/** A limb whose upper bone gets its twist from the hinge at its middle joint. */
interface Limb {
  readonly part: 'pelvis' | 'chest';
  readonly start: number;
  readonly middle: number;
  readonly end: number;
  readonly toe: number | null;
  /** Hinge axis in the rest pose, about which the limb bends. */
  readonly hinge: Float64Array;
}

const LIMBS: readonly Limb[] = [
  {
    part: 'pelvis',
    start: J.left_hip,
    middle: J.left_knee,
    end: J.left_ankle,
    toe: J.left_foot,
    hinge: Float64Array.of(1, 0, 0),
  },
  {
    part: 'pelvis',
    start: J.right_hip,
    middle: J.right_knee,
    end: J.right_ankle,
    toe: J.right_foot,
    hinge: Float64Array.of(1, 0, 0),
  },
  {
    part: 'chest',
    start: J.left_shoulder,
    middle: J.left_elbow,
    end: J.left_wrist,
    toe: null,
    hinge: Float64Array.of(0, -1, 0),
  },
  {
    part: 'chest',
    start: J.right_shoulder,
    middle: J.right_elbow,
    end: J.right_wrist,
    toe: null,
    hinge: Float64Array.of(0, 1, 0),
  },
];

/** Weight of the foot's direction in the leg's twist, where a knee bent at a right angle has 1. */
const FOOT_WEIGHT = 0.3;

const ROW = 3 * JOINT_COUNT;

/** Working memory of the functions below; nothing is kept from call to call. */
const rest = new Float64Array(3);
const towards = new Float64Array(3);
const base = new Float64Array(4);
const swing = new Float64Array(4);

/** Unit vector from joint to joint of the frame at `row`, or the fallback where they are at one place. */
function boneInto(
  out: Float64Array,
  o: number,
  joints: Float64Array,
  row: number,
  from: number,
  to: number,
  fallback: Float64Array,
  k: number,
): void {
  subtractInto(out, o, joints, row + 3 * to, joints, row + 3 * from);
  directionInto(out, o, out, o, fallback, k);
}

/** Hinge axes of a limb in world axes, frames x 3. */
function hingesOf(limb: Limb, { joints, trunk }: Poses, { directions }: Bones): Float64Array {
  const { start, middle, end, toe } = limb;
  const part = trunk[limb.part];
  const frames = part.length / 4;
  const upper = new Float64Array(frames * 3);
  const observed = new Float64Array(frames * 3);
  const priors = new Float64Array(frames * 3);
  const lower = new Float64Array(3);
  const foot = new Float64Array(3);
  for (let frame = 0; frame < frames; frame++) {
    const [at, turn, row] = [3 * frame, 4 * frame, ROW * frame];
    rotateInto(rest, 0, part, turn, directions, 3 * middle);
    boneInto(upper, at, joints, row, start, middle, rest, 0);
    boneInto(lower, 0, joints, row, middle, end, rest, 0);
    crossInto(observed, at, upper, at, lower, 0);
    if (toe !== null) {
      boneInto(foot, 0, joints, row, end, toe, rest, 0);
      crossInto(foot, 0, foot, 0, lower, 0);
      addInto(observed, at, observed, at, foot, 0, FOOT_WEIGHT);
    }
    // Into the axes of the part that carries the limb.
    rotateInverseInto(upper, at, part, turn, upper, at);
    rotateInverseInto(observed, at, part, turn, observed, at);
    betweenInto(swing, 0, directions, 3 * middle, upper, at);
    rotateInto(priors, at, swing, 0, limb.hinge, 0);
  }
  const hinges = smoothHinges(upper, observed, priors);
  for (let frame = 0; frame < frames; frame++)
    rotateInto(hinges, 3 * frame, part, 4 * frame, hinges, 3 * frame);
  return hinges;
}

/** What all frames share: the skeleton in motion, and the world rotations that are found, frames x 22 x 4. */
interface Rotating {
  readonly joints: Float64Array;
  readonly bones: Bones;
  readonly turns: Float64Array;
}

/**
 * Rotation of a joint whose bone leads to the joint `to`: a given rotation, and the swing from there onto the bone.
 * @param given with `g`: an array of quaternions and the index of one
 */
function aim(
  { joints, bones, turns }: Rotating,
  frame: number,
  joint: number,
  to: number,
  given: Float64Array,
  g: number,
): void {
  rotateInto(rest, 0, given, g, bones.directions, 3 * to);
  boneInto(towards, 0, joints, frame * ROW, joint, to, rest, 0);
  betweenInto(swing, 0, rest, 0, towards, 0);
  multiplyInto(turns, 4 * (frame * JOINT_COUNT + joint), swing, 0, given, g);
}

function copyTurn(turns: Float64Array, frame: number, joint: number, from: Float64Array, f: number): void {
  const at = 4 * (frame * JOINT_COUNT + joint);
  for (let i = 0; i < 4; i++) turns[at + i] = from[f + i]!;
}

/** Spine, neck, head and collars of every frame. */
function turnTrunk(rotating: Rotating, { pelvis, chest }: Poses['trunk']): void {
  const { turns } = rotating;
  for (let frame = 0; frame < pelvis.length / 4; frame++) {
    const at = 4 * frame;
    copyTurn(turns, frame, J.pelvis, pelvis, at);
    slerpInto(base, 0, pelvis, at, chest, at, 1 / 3);
    aim(rotating, frame, J.spine1, J.spine2, base, 0);
    slerpInto(base, 0, pelvis, at, chest, at, 2 / 3);
    aim(rotating, frame, J.spine2, J.spine3, base, 0);
    copyTurn(turns, frame, J.spine3, chest, at);
    aim(rotating, frame, J.neck, J.head, chest, at);
    // No joint position shows the head's own rotation: it is that of the neck.
    copyTurn(turns, frame, J.head, turns, 4 * (frame * JOINT_COUNT + J.neck));
    aim(rotating, frame, J.left_collar, J.left_shoulder, chest, at);
    aim(rotating, frame, J.right_collar, J.right_shoulder, chest, at);
  }
}

/** One limb of every frame, given its hinge axes in world axes. */
function turnLimb(rotating: Rotating, { start, middle, end, toe, hinge }: Limb, hinges: Float64Array): void {
  const { joints, bones, turns } = rotating;
  const fromRest = new Float64Array(4);
  fromAxesInto(fromRest, 0, hinge, 0, bones.directions, 3 * middle);
  for (let i = 0; i < 3; i++) fromRest[i]! *= -1;
  for (let frame = 0; frame < hinges.length / 3; frame++) {
    const at = (joint: number): number => 4 * (frame * JOINT_COUNT + joint);
    boneInto(towards, 0, joints, frame * ROW, start, middle, bones.directions, 3 * middle);
    fromAxesInto(base, 0, hinges, 3 * frame, towards, 0);
    multiplyInto(turns, at(start), base, 0, fromRest, 0);
    aim(rotating, frame, middle, end, turns, at(start));
    if (toe === null) copyTurn(turns, frame, end, turns, at(middle));
    else {
      aim(rotating, frame, end, toe, turns, at(middle));
      copyTurn(turns, frame, toe, turns, at(end));
    }
  }
}

/**
 * World rotations of all joints: of the trunk as fitted, of each limb about its hinge, smoothed over time, and of the
 * others by the shortest arc onto the next joint.
 *
 * @returns frames x 22 x 4
 */
export function worldRotations(poses: Poses, bones: Bones): Float64Array {
  const { joints, trunk } = poses;
  const turns = new Float64Array((joints.length / 3) * 4);
  const rotating = { joints, bones, turns };
  turnTrunk(rotating, trunk);
  for (const limb of LIMBS) turnLimb(rotating, limb, hingesOf(limb, poses, bones));
  return turns;
}
