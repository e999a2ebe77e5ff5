import { addEvenness, solvePentadiagonal } from '../math/pentadiagonal';
import type { ContactInterval } from './foot-contacts';

/** Weights of a slide during contact and of the shift's second difference over time; that of a shift of zero is about 1. */
const CONTACT_WEIGHT = 100;
const SMOOTHNESS_WEIGHT = 12;

/** A joint of the foot along one axis of the floor. */
export interface Track {
  /** Position in metres, one a frame. */
  readonly positions: Float64Array;
  readonly contacts: readonly ContactInterval[];
}

/**
 * Shift of a foot along one axis of the floor that keeps its joints in place during contact (footskate cleanup; Kovar,
 * Schreiner and Gleicher 2002), as one penalised least-squares problem over the whole clip: the shift s that minimises
 *
 *     sum w_t s_t^2 + CONTACT_WEIGHT (p_(t+1) + s_(t+1) - p_t - s_t)^2 + SMOOTHNESS_WEIGHT (s_(t-1) - 2 s_t + s_(t+1))^2
 *
 * with positions p, and the second term for joints and frames in contact only. A joint in contact thereby rests in the
 * middle of where it slid, the shift is smooth between two contacts, and it decays to zero in the air. A joint that
 * slides for long is not held: the shift lags behind and the foot follows slowly. The normal equations have five
 * diagonals.
 *
 * @param tracks the joints of one foot
 * @param zeroWeights weight of a shift of zero, w in the sum, one a frame; 1 where nothing else asks for more
 * @param contactWeight weight of a slide during contact
 * @returns the shift in metres, one a frame
 */
export function leastSquaresShift(
  tracks: readonly Track[],
  zeroWeights: Float64Array,
  contactWeight = CONTACT_WEIGHT,
): Float64Array {
  const frames = zeroWeights.length;
  const diagonal = Float64Array.from(zeroWeights);
  /** Coefficients between frame t and t + 1, t and t + 2. */
  const next = new Float64Array(frames);
  const second = new Float64Array(frames);
  const shift = new Float64Array(frames);
  for (const { positions, contacts } of tracks) {
    for (const { first, last } of contacts) {
      for (let t = first; t < last; t++) {
        const slide = positions[t + 1]! - positions[t]!;
        diagonal[t]! += contactWeight;
        diagonal[t + 1]! += contactWeight;
        next[t]! -= contactWeight;
        shift[t]! += contactWeight * slide;
        shift[t + 1]! -= contactWeight * slide;
      }
    }
  }
  addEvenness(diagonal, next, second, SMOOTHNESS_WEIGHT);
  return solvePentadiagonal(diagonal, next, second, shift);
}
