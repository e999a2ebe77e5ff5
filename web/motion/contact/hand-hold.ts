import { add, direction, length, readVec, scale, smoothstep, sub, type Vec3, ZERO } from '../math/vec3';
import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { ARMS, type LimbJoints } from '../skeleton/limbs';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { gaussianFilter } from '../math/statistics';
import { bonesAt, shiftEnd } from './shifted-limb';
import { maxLimbLength } from './two-bone-ik';

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
  const [own, theirs] = [handsOf(motion), handsOf(partner)];
  ARMS.forEach((arm, side) => {
    const shifts = shiftsOf(motion, arm, own[side]!, theirs);
    for (let frame = 0; frame < motion.frames; frame++) {
      const shift = vectorAt(shifts, frame);
      if (shift.some(Boolean)) shiftEnd(motion, arm, frame, shift, { rotations, positions });
    }
  });
  return { ...motion, rotations, positions };
}

/** One number a frame along each axis, metres. */
type Columns = readonly [Float64Array, Float64Array, Float64Array];

function columns(frames: number, at: (frame: number) => Vec3): Columns {
  const [x, y, z] = [new Float64Array(frames), new Float64Array(frames), new Float64Array(frames)];
  for (let frame = 0; frame < frames; frame++) {
    const vector = at(frame);
    x[frame] = vector[0];
    y[frame] = vector[1];
    z[frame] = vector[2];
  }
  return [x, y, z];
}

function filtered([x, y, z]: Columns, deviation: number): Columns {
  return [gaussianFilter(x, deviation), gaussianFilter(y, deviation), gaussianFilter(z, deviation)];
}

function vectorAt([x, y, z]: Columns, frame: number): Vec3 {
  return [x[frame]!, y[frame]!, z[frame]!];
}

/** Where the hand of each arm is held. */
function handsOf({ positions, frames }: Pick<MotionClip, 'positions' | 'frames'>): Columns[] {
  return ARMS.map((arm) =>
    columns(frames, (frame) => {
      const forearm = bonesAt(positions, arm, frame).lower;
      const wrist = readVec(positions, frame * JOINT_COUNT + arm.end);
      return add(wrist, scale(direction(forearm, ZERO), HAND));
    }),
  );
}

/** By how much a wrist goes with the hands of the partner that its hand is near. */
function shiftsOf(
  motion: SolvedMotion,
  arm: LimbJoints,
  own: Columns,
  partnersHands: readonly Columns[],
): Columns {
  const { frames, fps } = motion;
  const ways = partnersHands.map((hand) => {
    const way = columns(frames, (frame) => sub(vectorAt(own, frame), vectorAt(hand, frame)));
    return { way, slow: filtered(way, SMOOTHING * fps) };
  });
  const shifts = columns(frames, (frame) => {
    let [sum, weights] = [ZERO, 0];
    for (const { way, slow } of ways) {
      const mean = vectorAt(slow, frame);
      const far = length(mean);
      if (far >= FAR) continue;
      const weight = 1 - smoothstep(NEAR, FAR, far);
      const grip = scale(mean, Math.min(1, GRIP / far));
      sum = add(sum, scale(sub(grip, vectorAt(way, frame)), weight));
      weights += weight;
    }
    // Between both hands of the partner where both are near.
    return weights > 0 ? possible(motion, arm, frame, scale(sum, 1 / Math.max(1, weights))) : ZERO;
  });
  return filtered(shifts, STEADINESS * fps);
}

/** As much of a wrist's shift as the arm reaches; less of one that is long, and of an arm that is folded. */
function possible(motion: SolvedMotion, arm: LimbJoints, frame: number, wanted: Vec3): Vec3 {
  const { upper, lower } = bonesAt(motion.positions, arm, frame);
  const before = add(upper, lower);
  const after = add(before, scale(wanted, 1 - smoothstep(LONG, TOO_LONG, length(wanted))));
  const reached = scale(after, Math.min(1, maxLimbLength(upper, lower) / length(after)));
  const whole = length(upper) + length(lower);
  const open = (way: Vec3): number => smoothstep(FOLDED, OPEN, length(way) / whole);
  return scale(sub(reached, before), Math.min(open(before), open(after)));
}
