import { solveEven } from '../math/pentadiagonal';
import { add, writeVec } from '../math/vec3';
import type { SolvedMotion } from '../skeleton/clip';
import type { LegJoints } from '../skeleton/limbs';
import { JOINT_COUNT } from '../skeleton/skeleton';
import type { ContactInterval } from './foot-contacts';
import { bonesAt, type FootShift } from './shifted-limb';
import { maxLimbLength } from './two-bone-ik';

/** Weights of a slide during contact and of the shift's second difference over time; that of a shift of zero is about 1. */
const CONTACT_WEIGHT = 100;
const SMOOTHNESS_WEIGHT = 12;
/** Passes of iteratively reweighted least squares. */
const PASSES = 3;
/** By how much a leg may be too short for a shift before the weight of a shift of zero doubles, metres. */
const SHORTFALL = 0.002;

/** A joint of the foot along one axis of the floor. */
export interface Track {
  /** Position in metres, one a frame. */
  readonly positions: Float64Array;
  /** Weight of a slide from each frame to the next; frames - 1 numbers. */
  readonly weights: Float64Array;
}

/** Weights of the slides of a joint that is held in some intervals and free otherwise; frames - 1 numbers. */
export function contactWeights(
  frames: number,
  contacts: readonly ContactInterval[],
  weight = CONTACT_WEIGHT,
): Float64Array {
  const weights = new Float64Array(Math.max(0, frames - 1));
  for (const { first, last } of contacts) weights.fill(weight, first, last);
  return weights;
}

/**
 * Shift of a foot along one axis of the floor that keeps its joints in place during contact (footskate cleanup; Kovar,
 * Schreiner and Gleicher 2002), as one penalised least-squares problem over the whole clip: the shift s that minimises
 *
 *     sum z_t s_t^2 + w_t (p_(t+1) + s_(t+1) - p_t - s_t)^2 + smoothness (s_(t-1) - 2 s_t + s_(t+1))^2
 *
 * with positions p, and the second term for each joint. A joint in contact thereby rests in the middle of where it slid,
 * the shift is smooth between two contacts, and it decays to zero in the air. A joint that slides for long is not held:
 * the shift lags behind and the foot follows slowly. The normal equations have five diagonals.
 *
 * @param tracks the joints of one foot
 * @param zeroWeights weight of a shift of zero, z in the sum, one a frame; 1 where nothing else asks for more
 * @returns the shift in metres, one a frame
 */
export function leastSquaresShift(
  tracks: readonly Track[],
  zeroWeights: Float64Array,
  smoothness = SMOOTHNESS_WEIGHT,
): Float64Array {
  const frames = zeroWeights.length;
  const diagonal = Float64Array.from(zeroWeights);
  /** Coefficients between frame t and t + 1. */
  const next = new Float64Array(frames);
  const shift = new Float64Array(frames);
  for (const { positions, weights } of tracks) {
    weights.forEach((weight, t) => {
      if (weight === 0) return;
      const slide = positions[t + 1]! - positions[t]!;
      diagonal[t]! += weight;
      diagonal[t + 1]! += weight;
      next[t]! -= weight;
      shift[t]! += weight * slide;
      shift[t + 1]! -= weight * slide;
    });
  }
  return solveEven(diagonal, shift, smoothness, next);
}

/** How a foot is held. */
interface FootHold {
  /** Weights of the slides of a joint, its ankle or its toe; see `Track`. */
  readonly weights: (joint: number) => Float64Array;
  /** Weight of the shift's second difference. */
  readonly smoothness?: number | undefined;
}

/**
 * The shift of a foot, ankle and toe alike, that keeps them in place as `leastSquaresShift` does and that the leg reaches:
 * each pass raises the weight of a shift of zero where the pass before asked for more.
 * @returns metres along both axes of the floor, one a frame
 */
export function footShift(
  motion: SolvedMotion,
  leg: LegJoints,
  { weights, smoothness }: FootHold,
): FootShift {
  const { frames, positions } = motion;
  const feet = [leg.end, leg.toe].map((joint) => ({ joint, weights: weights(joint) }));
  const along = (axis: 0 | 2): Track[] =>
    feet.map(({ joint, weights }) => ({
      weights,
      positions: Float64Array.from(
        { length: frames },
        (_, t) => positions[(t * JOINT_COUNT + joint) * 3 + axis]!,
      ),
    }));
  const tracks = [along(0), along(2)] as const;
  const { ankles, reach } = legReach(motion, leg);
  const zeroWeights = new Float64Array(frames).fill(1);
  const held = (): [Float64Array, Float64Array] => [
    leastSquaresShift(tracks[0], zeroWeights, smoothness),
    leastSquaresShift(tracks[1], zeroWeights, smoothness),
  ];
  let [x, z] = held();
  for (let pass = 1; pass < PASSES; pass++) {
    for (let t = 0; t < frames; t++) {
      const ax = ankles[3 * t]! + x[t]!;
      const ay = ankles[3 * t + 1]!;
      const az = ankles[3 * t + 2]! + z[t]!;
      const shortfall = Math.max(0, Math.sqrt(ax * ax + ay * ay + az * az) - reach[t]!);
      zeroWeights[t]! *= 1 + shortfall / SHORTFALL;
    }
    [x, z] = held();
  }
  return { x, z };
}

/** Where the ankle is from the hip, frames x 3 metres, and how far from it the leg reaches, metres. */
function legReach(motion: SolvedMotion, leg: LegJoints): Record<'ankles' | 'reach', Float64Array> {
  const ankles = new Float64Array(3 * motion.frames);
  const reach = new Float64Array(motion.frames);
  for (let t = 0; t < motion.frames; t++) {
    const { upper, lower } = bonesAt(motion.positions, leg, t);
    writeVec(ankles, t, add(upper, lower));
    reach[t] = maxLimbLength(upper, lower);
  }
  return { ankles, reach };
}
