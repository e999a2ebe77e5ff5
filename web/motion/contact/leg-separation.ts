import type { SolvedMotion } from '../skeleton/clip';
import { segmentDistance } from '../math/segments';
import { gaussianFilter, runsOf } from '../math/statistics';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { withShiftedFeet } from './shifted-limb';
import { LEGS, type LegJoints } from '../skeleton/limbs';

/** Least distance between the axes of a dancer's lower legs, and of their feet, metres. */
const LEAST = 0.08;
/** Frames nearer than that belong to one encounter if no more than this lies between them, seconds. */
const PAUSE = 0.2;
/** Time before and after an encounter in which feet stay apart, and standard deviation of the way there, seconds. */
const HOLD = 0.1;
const SMOOTHING = 0.06;
/** Shifts of one foot against the other that are tried, metres over the floor: in so many directions, the shortest first. */
const DIRECTIONS = 12;
const SHIFTS = [0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.16].flatMap((size) =>
  Array.from({ length: DIRECTIONS }, (_, k) => {
    const angle = (2 * Math.PI * k) / DIRECTIONS;
    return { x: size * Math.cos(angle), z: size * Math.sin(angle) };
  }),
);

/** Numbers of a leg in a frame: x, y, z of knee, ankle and toe. */
const WIDTH = 9;

/** Lower legs and feet of one side, frames x 3 x 3 metres. */
function lowerLeg({ positions, frames }: SolvedMotion, { middle, end, toe }: LegJoints): Float64Array {
  const leg = new Float64Array(frames * WIDTH);
  for (let frame = 0; frame < frames; frame++)
    [middle, end, toe].forEach((joint, i) => {
      const at = 3 * (frame * JOINT_COUNT + joint);
      leg.set(positions.subarray(at, at + 3), frame * WIDTH + 3 * i);
    });
  return leg;
}

/** The smallest distance between lower legs and feet, each given from an offset, metres. */
function distanceBetween(left: Float64Array, i: number, right: Float64Array, j: number): number {
  return Math.min(
    segmentDistance(left, i, right, j),
    segmentDistance(left, i, right, j + 3),
    segmentDistance(left, i + 3, right, j),
    segmentDistance(left, i + 3, right, j + 3),
  );
}

/** The smallest of the shifts of the right foot that keeps the legs apart in these frames; the best where none does. */
function separation(left: Float64Array, right: Float64Array): { x: number; z: number } {
  const shifted = right.slice();
  const distanceWith = (x: number, z: number, enough: number): number => {
    let least = Infinity;
    for (let at = 0; at < left.length && least > enough; at += WIDTH) {
      // The knee stays.
      for (const i of [at + 3, at + 6]) {
        shifted[i] = right[i]! + x;
        shifted[i + 2] = right[i + 2]! + z;
      }
      least = Math.min(least, distanceBetween(left, at, shifted, at));
    }
    return least;
  };
  let best = { x: 0, z: 0 };
  let most = 0;
  for (const shift of SHIFTS) {
    const least = distanceWith(shift.x, shift.z, most);
    if (least > most) [best, most] = [shift, least];
    if (most >= LEAST) break;
  }
  return best;
}

/**
 * Keeps a dancer's legs out of each other, which nothing in the generation asks for: where lower legs or feet are nearer
 * than captured ones, both feet are moved apart, level with the floor, each by half of the smallest shift that serves
 * for the whole encounter. Thigh and shin follow by two-bone inverse kinematics; nothing else moves. Pure.
 */
export function separateLegs(motion: SolvedMotion): SolvedMotion {
  const { frames, fps } = motion;
  const [left, right] = LEGS.map((leg) => lowerLeg(motion, leg)) as [Float64Array, Float64Array];
  const near = Array.from(
    { length: frames },
    (_, frame) => distanceBetween(left, frame * WIDTH, right, frame * WIDTH) < LEAST,
  );
  const runs = runsOf(near, PAUSE * fps);
  if (runs.length === 0) return motion;
  const [x, z] = [new Float64Array(frames), new Float64Array(frames)];
  const hold = Math.round(HOLD * fps);
  for (const { from, to } of runs) {
    const during = (leg: Float64Array): Float64Array => leg.subarray(from * WIDTH, to * WIDTH);
    const shift = separation(during(left), during(right));
    x.fill(shift.x, Math.max(0, from - hold), to + hold);
    z.fill(shift.z, Math.max(0, from - hold), to + hold);
  }
  const half = (shift: Float64Array, side: number): Float64Array =>
    gaussianFilter(shift, SMOOTHING * fps).map((metres) => (side === 0 ? -0.5 : 0.5) * metres);
  return withShiftedFeet(motion, (_, side) => ({ x: half(x, side), z: half(z, side) }));
}
