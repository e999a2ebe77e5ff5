import type { ContactInterval } from '../../motion/contact/foot-contacts';
import { solveEven } from '../../motion/math/pentadiagonal';
import { median } from '../../motion/math/statistics';
import { distance, readVec, scale, type Vec3, writeVec } from '../../motion/math/vec3';
import { SIDES } from '../../motion/skeleton/skeleton';
import { LANDMARK_COUNT } from '../pose/landmarks';
import type { DepthCues } from './depth';
import { type Ground, onFloor } from './ground';
import { L } from '../pose/landmark-names';
import { raysOf } from './stance';

const LEGS = SIDES.map((side) => ({
  hip: L[`${side}_hip`],
  knee: L[`${side}_knee`],
  ankle: L[`${side}_ankle`],
  soles: [L[`${side}_heel`], L[`${side}_toe`]],
}));

/** Deviation of a foot's mean depth over a stance, relative to the hips, metres: in a stance the hips pass over it. */
const STANCE_DEVIATION = 0.08;
/** Weight of a shift of a foot that stands, of one of zero elsewhere, and of an even change. */
const STANDING_WEIGHT = 10;
const REST_WEIGHT = 0.02;
const EVEN_WEIGHT = 20;
/** Depths that are tried for a knee: so far from the first guess, and so many, metres. */
const KNEE_REACH = 0.25;
const KNEE_STEPS = 50;
/** Weight of a knee's first guess against the lengths of its bones. */
const GUESS_WEIGHT = 0.05;

/**
 * Puts feet and knees where they are seen, at depths that fit together: networks see how far a leg reaches towards the
 * camera or away from it too short. A foot that stands stays at one depth, that of the floor on its ray; between two
 * stances its shift changes evenly. Knees are where the bones have their lengths.
 * @param landmarks frames x 33 x 3 in the camera's axes, metres; feet and knees are written
 */
export function placeLegs(landmarks: Float64Array, cues: DepthCues, ground: Ground): void {
  for (const leg of LEGS) {
    const lengths = [boneLength(cues, leg.hip, leg.knee), boneLength(cues, leg.knee, leg.ankle)] as const;
    const shift = footShift(landmarks, cues, ground, leg.soles);
    for (const landmark of [leg.ankle, ...leg.soles]) {
      const rays = raysOf(cues.series, landmark, cues.focal);
      for (let t = 0; t < shift.length; t++) {
        const z = landmarks[3 * (t * LANDMARK_COUNT + landmark) + 2]! + shift[t]!;
        writeVec(landmarks, t * LANDMARK_COUNT + landmark, [rays.x[t]! * z, rays.y[t]! * z, z]);
      }
    }
    for (const landmark of leg.soles) holdStill(landmarks, cues, landmark, leg);
    const rays = raysOf(cues.series, leg.knee, cues.focal);
    for (let t = 0; t < shift.length; t++) {
      const at = (landmark: number): Vec3 => readVec(landmarks, t * LANDMARK_COUNT + landmark);
      const guess = at(leg.knee)[2] + shift[t]! / 2;
      const knee = kneeOn([rays.x[t]!, rays.y[t]!, 1], guess, [at(leg.hip), at(leg.ankle)], lengths);
      writeVec(landmarks, t * LANDMARK_COUNT + leg.knee, knee);
    }
  }
}

/** The length of a bone: its median over time. */
function boneLength({ world, series }: DepthCues, from: number, to: number): number {
  return median(
    Float64Array.from({ length: series.frames }, (_, t) =>
      distance(readVec(world, t * LANDMARK_COUNT + from), readVec(world, t * LANDMARK_COUNT + to)),
    ),
  );
}

/** How much deeper a foot is than it was seen, one number a frame, metres. */
function footShift(
  landmarks: Float64Array,
  { series, stances, focal }: DepthCues,
  ground: Ground,
  soles: readonly number[],
): Float64Array {
  const held = stances
    .filter(({ landmark }) => soles.includes(landmark))
    .flatMap(({ landmark, intervals }) => {
      const floor = onFloor(raysOf(series, landmark, focal), ground, series, focal);
      const seen = (t: number): number => landmarks[3 * (t * LANDMARK_COUNT + landmark) + 2]!;
      return intervals.map((interval): Held => {
        let [sum, weights] = [0, 0];
        for (let t = interval.first; t <= interval.last; t++) {
          const [onRay, byBody] = [1 / floor.deviation[t]! ** 2, 1 / STANCE_DEVIATION ** 2];
          sum += onRay * floor.depth[t]! + byBody * seen(t);
          weights += onRay + byBody;
        }
        return { interval, seen, target: sum / weights };
      });
    });
  return shiftTo(held, series.frames);
}

/** Shifts a sole, and with the heel the ankle, so that it stays in its mean place while it stands. */
function holdStill(
  landmarks: Float64Array,
  { series, stances }: DepthCues,
  landmark: number,
  { ankle, soles: [heel] }: (typeof LEGS)[number],
): void {
  const intervals = stances.find((one) => one.landmark === landmark)?.intervals ?? [];
  const moved = landmark === heel ? [heel, ankle] : [landmark];
  for (const axis of [0, 1, 2]) {
    const at = (t: number, which: number): number => 3 * (t * LANDMARK_COUNT + which) + axis;
    const seen = (t: number): number => landmarks[at(t, landmark)]!;
    const held = intervals.map((interval): Held => {
      let sum = 0;
      for (let t = interval.first; t <= interval.last; t++) sum += seen(t);
      return { interval, seen, target: sum / (interval.last - interval.first + 1) };
    });
    const shift = shiftTo(held, series.frames);
    for (const which of moved) shift.forEach((value, t) => (landmarks[at(t, which)]! += value));
  }
}

/** A coordinate that is to stay at `target` for an interval, metres. */
interface Held {
  readonly interval: ContactInterval;
  readonly seen: (t: number) => number;
  readonly target: number;
}

/** The shift, one number a frame, that brings coordinates to their targets and changes evenly in between. */
function shiftTo(held: readonly Held[], frames: number): Float64Array {
  const diagonal = new Float64Array(frames).fill(REST_WEIGHT);
  const shift = new Float64Array(frames);
  for (const { interval, seen, target } of held)
    for (let t = interval.first; t <= interval.last; t++) {
      diagonal[t]! += STANDING_WEIGHT;
      shift[t]! += STANDING_WEIGHT * (target - seen(t));
    }
  return solveEven(diagonal, shift, EVEN_WEIGHT);
}

/** The point on a ray at which both bones of a leg are nearest to their lengths. */
function kneeOn(
  ray: Vec3,
  guess: number,
  [hip, ankle]: readonly [Vec3, Vec3],
  [thigh, shin]: readonly [number, number],
): Vec3 {
  let best = scale(ray, guess);
  let least = Infinity;
  for (let i = 0; i <= KNEE_STEPS; i++) {
    const away = KNEE_REACH * ((2 * i) / KNEE_STEPS - 1);
    const knee = scale(ray, guess + away);
    const cost =
      (distance(knee, hip) - thigh) ** 2 + (distance(knee, ankle) - shin) ** 2 + GUESS_WEIGHT * away * away;
    if (cost >= least) continue;
    least = cost;
    best = knee;
  }
  return best;
}
