import type { SolvedMotion } from '../skeleton/clip';
import { contactIntervals } from './foot-contacts';
import { leastSquaresShift, type FloorShift, normalEquations } from './least-squares-shift';
import { LEG, maxLegLength, twoBoneIk } from './two-bone-ik';
import { multiplyInto, multiplyInverseInto, rotateInto } from '../math/flat-quaternions';
import { addInto, AXES, copyInto, subtractInto } from '../math/flat-vectors';
import { J, JOINT_COUNT } from '../skeleton/skeleton';

/** Joint indices of a leg. */
interface LegJoints {
  readonly hip: number;
  readonly knee: number;
  readonly ankle: number;
  readonly toe: number;
}

const LEGS: readonly LegJoints[] = [
  { hip: J.left_hip, knee: J.left_knee, ankle: J.left_ankle, toe: J.left_foot },
  { hip: J.right_hip, knee: J.right_knee, ankle: J.right_ankle, toe: J.right_foot },
];

/** Shift above which its own weight grows, metres: a foot that would be moved farther is released gradually. */
const MAX_SHIFT = 0.1;
/** Passes of iteratively reweighted least squares. */
const PASSES = 6;
/** By how much a leg may be too short for a shift before the weight of a shift of zero doubles, metres. */
const SHORTFALL = 0.002;

const ROW = 3 * JOINT_COUNT;

/** A leg over time: `LEG` rows, and the world rotations of thigh, shin and foot, frames x 3 x 4. */
interface MovingLeg {
  readonly rows: Float64Array;
  readonly turns: Float64Array;
}

/** Both arrays are those of the motion, as doubles. */
function movingLeg(
  positions: Float64Array,
  rotations: Float64Array,
  { hip, knee, ankle }: LegJoints,
): MovingLeg {
  const frames = positions.length / ROW;
  const rows = new Float64Array(frames * LEG.size);
  const turns = new Float64Array(frames * 12);
  for (let frame = 0; frame < frames; frame++) {
    const [at, turn, leg] = [ROW * frame, 12 * frame, LEG.size * frame];
    const local = 4 * JOINT_COUNT * frame;
    multiplyInto(turns, turn, rotations, local + 4 * J.pelvis, rotations, local + 4 * hip);
    multiplyInto(turns, turn + 4, turns, turn, rotations, local + 4 * knee);
    multiplyInto(turns, turn + 8, turns, turn + 4, rotations, local + 4 * ankle);
    copyInto(rows, leg + LEG.hip, positions, at + 3 * hip);
    subtractInto(rows, leg + LEG.thigh, positions, at + 3 * knee, positions, at + 3 * hip);
    subtractInto(rows, leg + LEG.shin, positions, at + 3 * ankle, positions, at + 3 * knee);
    // In the rest pose knees bend about x.
    rotateInto(rows, leg + LEG.hinge, turns, turn, AXES, 0);
  }
  return { rows, turns };
}

/**
 * The shift that keeps a foot in place while it is in contact. Each pass raises the weight of a shift of zero where the
 * pass before asked for too much.
 */
function shiftOf(motion: SolvedMotion, { ankle, toe }: LegJoints, legs: Float64Array): FloorShift {
  const { frames, positions } = motion;
  const coordinate = (joint: number, axis: 0 | 2): Float64Array =>
    Float64Array.from({ length: frames }, (_, frame) => positions[frame * ROW + 3 * joint + axis]!);
  const tracks = [ankle, toe].map((joint) => ({
    contacts: contactIntervals(motion, joint),
    x: coordinate(joint, 0),
    z: coordinate(joint, 2),
  }));
  const equations = normalEquations(tracks, frames);
  const zeroWeights = new Float64Array(frames).fill(1);
  let shift = leastSquaresShift(equations, zeroWeights);
  for (let pass = 1; pass < PASSES; pass++) {
    raiseWeights(zeroWeights, shift, legs);
    shift = leastSquaresShift(equations, zeroWeights);
  }
  return shift;
}

/** Raises the weights of a shift of zero where a shift is too long, or its leg too short for it. */
function raiseWeights(zeroWeights: Float64Array, { x, z }: FloorShift, legs: Float64Array): void {
  for (let t = 0; t < zeroWeights.length; t++) {
    const thigh = LEG.size * t + LEG.thigh;
    const shin = LEG.size * t + LEG.shin;
    const excess = Math.max(1, Math.sqrt(x[t]! * x[t]! + z[t]! * z[t]!) / MAX_SHIFT);
    const legX = legs[thigh]! + legs[shin]! + x[t]!;
    const legY = legs[thigh + 1]! + legs[shin + 1]!;
    const legZ = legs[thigh + 2]! + legs[shin + 2]! + z[t]!;
    const length = Math.sqrt(legX * legX + legY * legY + legZ * legZ);
    const shortfall = Math.max(0, length - maxLegLength(legs, LEG.size * t));
    zeroWeights[t]! *= excess * excess * (1 + shortfall / SHORTFALL);
  }
}

/** Writes a leg with its foot shifted into the rotations and positions of a motion. */
function putLeg(
  { offsets, rotations, positions }: SolvedMotion,
  { hip, knee, ankle, toe }: LegJoints,
  { rows, turns }: MovingLeg,
  shift: FloorShift,
): void {
  const bones = new Float64Array(offsets);
  const target = new Float64Array(3);
  const bone = new Float64Array(3);
  /** The leg's new rotations in world axes: pelvis, thigh, shin and foot. */
  const world = new Float64Array(16);
  const local = new Float64Array(4);
  const chain = [hip, knee, ankle, toe];
  for (let frame = 0; frame < shift.x.length; frame++) {
    const leg = LEG.size * frame;
    addInto(target, 0, rows, leg + LEG.hip, rows, leg + LEG.thigh);
    addInto(target, 0, target, 0, rows, leg + LEG.shin);
    target[0]! += shift.x[frame]!;
    target[2]! += shift.z[frame]!;
    for (let i = 0; i < 4; i++) world[i] = rotations[4 * JOINT_COUNT * frame + i]!;
    twoBoneIk(ikTurns, rows, leg, target);
  }
}
