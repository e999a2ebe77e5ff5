import {
  add,
  direction,
  length,
  readVec,
  scale,
  smoothstep,
  sub,
  type Vec3,
  writeVec,
  ZERO,
} from '../math/vec3';
import { conjugate, multiply, type Quat, readQuat, rotate, writeQuat } from '../math/quat';
import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { J, JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import { gaussianFilter } from '../math/statistics';
import { bonesAt, maxLimbLength, twoBoneIk } from './two-bone-ik';

/**
 * From the wrist to where a hand is held, on from the forearm, metres. Where captured dancers hold hands, points there
 * are nearest to each other.
 */
const HAND = 0.15;
/** Distance of two hands up to which they hold each other, and from which on they do not, metres. */
const NEAR = 0.2;
const FAR = 0.35;
/** Greatest distance of hands that hold each other, metres. */
const GRIP = 0.05;
/** Standard deviation of the filter that leaves the slow part of the way from hand to hand, seconds. */
const SMOOTHING = 0.3;
/** Shift of a hand from which on it begins to let go, and from which on it stays where it was, metres. */
const LONG = 0.2;
const TOO_LONG = 0.4;
/**
 * Distance of a wrist from its shoulder, as a share of the arm's length, up to which the arm stays as it is, and from
 * which the hand is free to be held: near the shoulder a small shift swings the whole arm.
 */
const FOLDED = 0.4;
const OPEN = 0.8;
/** Standard deviation of the filter over the shifts, which keeps out jerks of the partner's hands, seconds. */
const STEADINESS = 0.067;

interface ArmJoints {
  readonly shoulder: number;
  readonly elbow: number;
  readonly wrist: number;
  /** The axis about which the elbow bends in the rest pose. */
  readonly hinge: Vec3;
}

const ARMS: readonly ArmJoints[] = [
  { shoulder: J.left_shoulder, elbow: J.left_elbow, wrist: J.left_wrist, hinge: [0, -1, 0] },
  { shoulder: J.right_shoulder, elbow: J.right_elbow, wrist: J.right_wrist, hinge: [0, 1, 0] },
];

/**
 * Lets a dancer hold the partner's hands where their own are near them.
 *
 * Decoded hands come to the right region but drift about in it, while hands that hold each other go the same way. So
 * near a hand of the partner the way from hand to hand is replaced by its slow part, no longer than a grip. Upper arms
 * and forearms follow by two-bone inverse kinematics; nothing else moves, and the partner stays. Pure.
 *
 * @param partner of the same frames and rate
 */
export function holdHands(motion: SolvedMotion, partner: MotionClip): SolvedMotion {
  const rotations = motion.rotations.slice();
  const positions = motion.positions.slice();
  for (const arm of ARMS) {
    const shifts = shiftsOf(motion, partner, arm);
    for (let frame = 0; frame < motion.frames; frame++) {
      const shift = readVec(shifts, frame);
      if (shift.some(Boolean)) shiftWrist(motion, arm, frame, shift, { rotations, positions });
    }
  }
  return { ...motion, rotations, positions };
}

/** By how much a wrist goes with the hands of the partner that it is near, frames x 3 metres. */
function shiftsOf(motion: SolvedMotion, partner: MotionClip, arm: ArmJoints): Float64Array {
  const { positions, frames, fps } = motion;
  const ways = ARMS.map((theirs) => {
    const way = new Float64Array(3 * frames);
    for (let frame = 0; frame < frames; frame++)
      writeVec(way, frame, sub(handAt(positions, arm, frame), handAt(partner.positions, theirs, frame)));
    return { way, slow: filtered(way, SMOOTHING * fps) };
  });
  const shifts = new Float64Array(3 * frames);
  for (let frame = 0; frame < frames; frame++) {
    let [sum, weights] = [ZERO, 0];
    for (const { way, slow } of ways) {
      const mean = readVec(slow, frame);
      const far = length(mean);
      const weight = 1 - smoothstep(NEAR, FAR, far);
      const grip = scale(mean, Math.min(1, GRIP / far || 1));
      sum = add(sum, scale(sub(grip, readVec(way, frame)), weight));
      weights += weight;
    }
    // Between both hands of the partner where both are near.
    if (weights > 0)
      writeVec(shifts, frame, possible(motion, arm, frame, scale(sum, 1 / Math.max(1, weights))));
  }
  return filtered(shifts, STEADINESS * fps);
}

/** Where a hand is held in a frame, metres. */
function handAt(positions: Float32Array, { elbow, wrist }: ArmJoints, frame: number): Vec3 {
  const row = frame * JOINT_COUNT;
  const at = readVec(positions, row + wrist);
  return add(at, scale(direction(sub(at, readVec(positions, row + elbow)), ZERO), HAND));
}

/** As much of a wrist's shift as the arm reaches; less of one that is long, and of an arm that is folded. */
function possible(
  motion: SolvedMotion,
  { shoulder, elbow, wrist }: ArmJoints,
  frame: number,
  wanted: Vec3,
): Vec3 {
  const { upper, lower } = bonesAt(motion.positions, frame, [shoulder, elbow, wrist]);
  const before = add(upper, lower);
  const after = add(before, scale(wanted, 1 - smoothstep(LONG, TOO_LONG, length(wanted))));
  const reached = scale(after, Math.min(1, maxLimbLength(upper, lower) / length(after) || 1));
  const whole = length(upper) + length(lower);
  const open = (arm: Vec3): number => smoothstep(FOLDED, OPEN, length(arm) / whole);
  return scale(sub(reached, before), Math.min(open(before), open(after)));
}

/** Rows of three numbers, each column filtered. @param deviation in rows */
function filtered(rows: Float64Array, deviation: number): Float64Array {
  const out = new Float64Array(rows.length);
  for (let axis = 0; axis < 3; axis++) {
    const column = gaussianFilter(
      rows.filter((_, i) => i % 3 === axis),
      deviation,
    );
    column.forEach((value, row) => (out[3 * row + axis] = value));
  }
  return out;
}

/** Writes one arm of one frame with its wrist shifted; the hand keeps its rotation to the forearm. */
function shiftWrist(
  motion: SolvedMotion,
  { shoulder, elbow, wrist, hinge }: ArmJoints,
  frame: number,
  shift: Vec3,
  shifted: Pick<SolvedMotion, 'rotations' | 'positions'>,
): void {
  const row = frame * JOINT_COUNT;
  const parent = worldRotation(motion.rotations, row, PARENTS[shoulder]!);
  const upperArm = multiply(parent, readQuat(motion.rotations, row + shoulder));
  const forearm = multiply(upperArm, readQuat(motion.rotations, row + elbow));
  const arm = {
    ...bonesAt(motion.positions, frame, [shoulder, elbow, wrist]),
    hinge: rotate(upperArm, hinge),
  };
  const turns = twoBoneIk(arm, add(readVec(motion.positions, row + wrist), shift));
  const [upper, lower] = [multiply(turns.upper, upperArm), multiply(turns.lower, forearm)];
  writeQuat(shifted.rotations, row + shoulder, multiply(conjugate(parent), upper));
  writeQuat(shifted.rotations, row + elbow, multiply(conjugate(upper), lower));
  const place = (joint: number, from: Vec3, turn: Quat): Vec3 => {
    const to = add(from, rotate(turn, readVec(motion.offsets, joint)));
    writeVec(shifted.positions, row + joint, to);
    return to;
  };
  place(wrist, place(elbow, arm.start, upper), lower);
}

/** The rotation of a joint in world axes. @param row that of the frame's first joint */
function worldRotation(rotations: Float32Array, row: number, joint: number): Quat {
  const own = readQuat(rotations, row + joint);
  return joint === 0 ? own : multiply(worldRotation(rotations, row, PARENTS[joint]!), own);
}
