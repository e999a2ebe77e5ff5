import type { Stretch } from './foot-contacts';

/** How strongly a planted joint resists to slide, and a shift to bend over time, against its wish to be zero. */
const GRIP = 100;
const SMOOTHNESS = 12;

/** A joint of the foot on one axis of the floor. */
export interface Track {
  /** Place in metres, one a frame. */
  readonly places: Float64Array;
  readonly planted: readonly Stretch[];
}

/**
 * How far to shift a foot along one axis of the floor so that its planted joints rest: least squares over the whole
 * clip of
 *
 *     sum stay_t s_t^2 + GRIP sum_planted (slide of a joint at place + s)^2 + SMOOTHNESS sum (s_(t-1) - 2 s_t + s_(t+1))^2
 *
 * A planted joint thereby rests in the middle of where it slid, the shift comes and goes smoothly between two
 * stretches, and it vanishes in the air. A joint that slides on for long is not held for ever: the shift lags behind
 * and the foot follows slowly. The system has five diagonals and is solved in place, as L D L^T.
 *
 * @param tracks the joints of one foot
 * @param stay pull back to where the foot was, one a frame, 1 where nothing else asks for more
 * @returns the shift in metres, one a frame
 */
export function restingShift(tracks: readonly Track[], stay: Float64Array): Float64Array {
  const frames = stay.length;
  const diagonal = Float64Array.from(stay);
  /** Coefficients between frame t and t + 1, t and t + 2. */
  const next = new Float64Array(frames);
  const second = new Float64Array(frames);
  const shift = new Float64Array(frames);
  for (const { places, planted } of tracks) {
    for (const { first, last } of planted) {
      for (let t = first; t < last; t++) {
        const slide = places[t + 1]! - places[t]!;
        diagonal[t]! += GRIP;
        diagonal[t + 1]! += GRIP;
        next[t]! -= GRIP;
        shift[t]! += GRIP * slide;
        shift[t + 1]! -= GRIP * slide;
      }
    }
  }
  for (let t = 1; t < frames - 1; t++) {
    diagonal[t - 1]! += SMOOTHNESS;
    diagonal[t]! += 4 * SMOOTHNESS;
    diagonal[t + 1]! += SMOOTHNESS;
    next[t - 1]! -= 2 * SMOOTHNESS;
    next[t]! -= 2 * SMOOTHNESS;
    second[t - 1]! += SMOOTHNESS;
  }
  for (let t = 0; t < frames; t++) {
    const [pivot, one, two] = [diagonal[t]!, next[t]! / diagonal[t]!, second[t]! / diagonal[t]!];
    if (t + 1 < frames) {
      diagonal[t + 1]! -= one * one * pivot;
      next[t + 1]! -= one * two * pivot;
      shift[t + 1]! -= one * shift[t]!;
    }
    if (t + 2 < frames) {
      diagonal[t + 2]! -= two * two * pivot;
      shift[t + 2]! -= two * shift[t]!;
    }
    next[t] = one;
    second[t] = two;
    shift[t]! /= pivot;
  }
  for (let t = frames - 2; t >= 0; t--) {
    shift[t]! -= next[t]! * shift[t + 1]! + (t + 2 < frames ? second[t]! * shift[t + 2]! : 0);
  }
  return shift;
}
