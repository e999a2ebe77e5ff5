import {
  type BodyRule,
  type CapsuleBody,
  capsuleBody,
  candidatePairs,
  type LevelVector,
  penetrationDepth,
} from './capsules';
import { gaussianFilter, windowMaximum } from '../math/statistics';
import { type MotionClip, shiftedLevel, type SolvedMotion } from '../skeleton/clip';
import { headingOf } from '../skeleton/heading';
import { JOINT_COUNT, type JointName } from '../skeleton/skeleton';

/** Joints that end the bones of the arms. Partners hold each other, so arms may overlap. */
const ARMS: ReadonlySet<JointName> = new Set(['left_elbow', 'left_wrist', 'right_elbow', 'right_wrist']);
/** The direction away from the other dancer is measured from a point this far behind their pelvis, metres. */
const BEHIND = 0.2;
/** Standard deviation of the Gaussian filter over that direction, seconds. */
const DIRECTION_SMOOTHING = 0.6;
/** Longest shift, metres. */
const MAX_SHIFT = 0.6;
/** A shift may be longer than necessary by so much, metres. */
const PRECISION = 0.002;
/** Factor on the necessary shift, of which the filter takes some away. */
const SPARE = 1.25;
/** How long before and after a frame its shift is held, and standard deviation of the filter over the shift, seconds. */
const HOLD = 0.3;
const SMOOTHING = 0.2;

/** Unit vectors level with the floor, one a frame. */
interface Directions {
  readonly x: Float64Array;
  readonly z: Float64Array;
}

/** Away from the other dancer, smoothly over time; the way that they face where both stand in one place. */
function directionsAway(motion: MotionClip, other: MotionClip): Directions {
  const { frames, fps } = motion;
  const [x, z] = [new Float64Array(frames), new Float64Array(frames)];
  const width = 3 * JOINT_COUNT;
  for (let frame = 0; frame < frames; frame++) {
    const root = frame * width;
    const heading = headingOf(other.positions.subarray(root, root + width));
    x[frame] = motion.positions[root]! - other.positions[root]! + BEHIND * Math.sin(heading);
    z[frame] = motion.positions[root + 2]! - other.positions[root + 2]! + BEHIND * Math.cos(heading);
  }
  const deviation = DIRECTION_SMOOTHING * fps;
  const [smoothX, smoothZ] = [gaussianFilter(x, deviation), gaussianFilter(z, deviation)];
  const length = smoothX.map((along, frame) => Math.hypot(along, smoothZ[frame]!) || 1);
  return {
    x: smoothX.map((along, frame) => along / length[frame]!),
    z: smoothZ.map((along, frame) => along / length[frame]!),
  };
}

/**
 * How far the second dancer has to go in a direction until no overlap is left, metres; 0 where there is none. By
 * sphere tracing (Hart, Sphere tracing: a geometric method for the antialiased ray tracing of implicit surfaces, 1996):
 * a step as long as the overlap is deep cannot pass its end.
 */
function shiftOut(
  a: CapsuleBody,
  b: CapsuleBody,
  frame: number,
  direction: LevelVector,
  deep: number,
): number {
  let depth = penetrationDepth(a, b, candidatePairs(a, b, frame));
  if (depth <= deep) return 0;
  const pairs = candidatePairs(a, b, frame, MAX_SHIFT);
  let shift = 0;
  while (depth > deep && shift < MAX_SHIFT) {
    shift += depth - deep + PRECISION;
    depth = penetrationDepth(a, b, pairs, { x: shift * direction.x, z: shift * direction.z });
  }
  return shift;
}

/**
 * Collision avoidance between two dancers: where trunks, heads or legs would overlap, the whole dancer is shifted away
 * from the other one, level with the floor, by at most 0.6 m. Arms may overlap. Rotations, heights and bone lengths stay.
 * A motion without overlap is returned as it is. Pure.
 *
 * The direction comes from where both stand and the length from the overlap, so that motions that differ little are
 * shifted alike: while guidance is changed, the dancer goes smoothly with it. The exception is a dancer whose pelvis
 * comes close to the point `BEHIND` the other's, from which no direction leads away: some overlap is left there.
 *
 * @param motion the dancer who is shifted
 * @param other the dancer who stays, of the same frames and rate
 * @param rule capsules of the bodies, and the depth from which an overlap counts
 */
export function avoidCollisions(motion: SolvedMotion, other: MotionClip, rule: BodyRule): SolvedMotion {
  const { fps } = motion;
  const withoutArms = {
    ...rule,
    capsules: rule.capsules.filter(({ from, to }) => !ARMS.has(from) && !ARMS.has(to)),
  };
  const [a, b] = [capsuleBody(other, withoutArms), capsuleBody(motion, withoutArms)];
  const away = directionsAway(motion, other);
  const necessary = away.x.map((x, frame) => shiftOut(a, b, frame, { x, z: away.z[frame]! }, rule.deep));
  if (!necessary.some(Boolean)) return motion;
  const long = necessary.map((shift) => Math.min(MAX_SHIFT, SPARE * shift));
  const held = windowMaximum(long, Math.round(HOLD * fps));
  const shiftAlong = (direction: Float64Array): Float64Array =>
    gaussianFilter(
      direction.map((share, frame) => share * held[frame]!),
      SMOOTHING * fps,
    );
  return shiftedLevel(motion, shiftAlong(away.x), shiftAlong(away.z));
}
