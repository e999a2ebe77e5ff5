import type { ContactInterval } from './foot-contacts';

/** Weights of a slide during contact and of the shift's second difference over time; that of a shift of zero is about 1. */
const CONTACT_WEIGHT = 100;
const SMOOTHNESS_WEIGHT = 12;

/** A joint of the foot over the floor. */
export interface Track {
  /** Positions along the two axes of the floor in metres, one a frame. */
  readonly x: Float64Array;
  readonly z: Float64Array;
  readonly contacts: readonly ContactInterval[];
}

/** One number a frame for each axis of the floor. */
export interface FloorShift {
  readonly x: Float64Array;
  readonly z: Float64Array;
}

/** Normal equations of the shift, but for the weights of a shift of zero; one number a frame. */
export interface NormalEquations {
  readonly diagonal: Float64Array;
  /** Coefficients between frame t and t + 1, t and t + 2. */
  readonly next: Float64Array;
  readonly second: Float64Array;
  /** Right sides. */
  readonly sides: FloorShift;
}

/**
 * Equations of the shift over the floor that keeps the joints of a foot in place during contact (footskate cleanup;
 * Kovar, Schreiner and Gleicher 2002), as one penalised least-squares problem over the whole clip: along each axis the
 * shift s that minimises
 *
 *     sum w_t s_t^2 + CONTACT_WEIGHT (p_(t+1) + s_(t+1) - p_t - s_t)^2 + SMOOTHNESS_WEIGHT (s_(t-1) - 2 s_t + s_(t+1))^2
 *
 * with positions p, and the second term for joints and frames in contact only. A joint in contact thereby rests in the
 * middle of where it slid, the shift is smooth between two contacts, and it decays to zero in the air. A joint that
 * slides for long is not held: the shift lags behind and the foot follows slowly.
 *
 * @param tracks the joints of one foot
 */
export function normalEquations(tracks: readonly Track[], frames: number): NormalEquations {
  const diagonal = new Float64Array(frames);
  const next = new Float64Array(frames);
  const second = new Float64Array(frames);
  const sides = { x: new Float64Array(frames), z: new Float64Array(frames) };
  for (const { x, z, contacts } of tracks) {
    for (const { first, last } of contacts) {
      for (let t = first; t < last; t++) {
        diagonal[t]! += CONTACT_WEIGHT;
        diagonal[t + 1]! += CONTACT_WEIGHT;
        next[t]! -= CONTACT_WEIGHT;
        const slideX = CONTACT_WEIGHT * (x[t + 1]! - x[t]!);
        const slideZ = CONTACT_WEIGHT * (z[t + 1]! - z[t]!);
        sides.x[t]! += slideX;
        sides.x[t + 1]! -= slideX;
        sides.z[t]! += slideZ;
        sides.z[t + 1]! -= slideZ;
      }
    }
  }
  for (let t = 1; t < frames - 1; t++) {
    diagonal[t - 1]! += SMOOTHNESS_WEIGHT;
    diagonal[t]! += 4 * SMOOTHNESS_WEIGHT;
    diagonal[t + 1]! += SMOOTHNESS_WEIGHT;
    next[t - 1]! -= 2 * SMOOTHNESS_WEIGHT;
    next[t]! -= 2 * SMOOTHNESS_WEIGHT;
    second[t - 1]! += SMOOTHNESS_WEIGHT;
  }
  return { diagonal, next, second, sides };
}

/**
 * The shift that solves these equations: their matrix has five diagonals and is factorised as L D L^T, once for both axes.
 *
 * @param zeroWeights weight of a shift of zero, w in the sum, one a frame; 1 where nothing else asks for more
 * @returns the shift in metres
 */
export function leastSquaresShift(equations: NormalEquations, zeroWeights: Float64Array): FloorShift {
  const frames = zeroWeights.length;
  const pivots = equations.diagonal.slice();
  const next = equations.next.slice();
  const second = equations.second.slice();
  const x = equations.sides.x.slice();
  const z = equations.sides.z.slice();
  for (let t = 0; t < frames; t++) {
    const pivot = pivots[t]! + zeroWeights[t]!;
    const one = next[t]! / pivot;
    const two = second[t]! / pivot;
    if (t + 1 < frames) {
      pivots[t + 1]! -= one * one * pivot;
      next[t + 1]! -= one * two * pivot;
      x[t + 1]! -= one * x[t]!;
      z[t + 1]! -= one * z[t]!;
    }
    if (t + 2 < frames) {
      pivots[t + 2]! -= two * two * pivot;
      x[t + 2]! -= two * x[t]!;
      z[t + 2]! -= two * z[t]!;
    }
    next[t] = one;
    second[t] = two;
    x[t]! /= pivot;
    z[t]! /= pivot;
  }
  for (let t = frames - 2; t >= 0; t--) {
    // Beyond the last frame `second` is zero.
    const after = Math.min(t + 2, frames - 1);
    x[t]! -= next[t]! * x[t + 1]! + second[t]! * x[after]!;
    z[t]! -= next[t]! * z[t + 1]! + second[t]! * z[after]!;
  }
  return { x, z };
}
