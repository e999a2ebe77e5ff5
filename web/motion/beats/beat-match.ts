import { mean } from '../math/statistics';

/** Largest shift that is tried, frames to either side. */
const MAX_SHIFT_FRAMES = 60;
/** Fewest beats of motion and music that are compared. */
const MIN_BEATS = 6;
/** Share of the best score from which a peak counts as equal; of these the smallest shift is taken, as beats repeat. */
const EQUAL_SHARE = 0.98;
/** Gain of the score, and gain over its standard error, from which a shift is clearly better. */
const MIN_GAIN = 0.1;
const MIN_CONFIDENCE = 2;

/** The best shift of the music. Scores are between 0 and 1: the mean over the motion beats during the music. */
export interface BestShift {
  /** Frames by which the music has to start later. */
  readonly by: number;
  readonly score: number;
  /** The score without a shift. */
  readonly before: number;
  /** Whether it is clearly better than no shift. Among so many shifts one is always a little better by chance. */
  readonly clear: boolean;
}

/**
 * Beat alignment of each motion beat with the music (Li et al. 2021): exp(-d^2 / (2 * tolerance^2)), d the frames to
 * the nearest music beat; `beat_scores` of training/evaluation/metrics/beats.py with the motion's beats as reference.
 * @param motion frames in any order
 * @param music frames in ascending order, whole or not
 * @param tolerance standard deviation of the score, frames; the manifest's
 */
export function beatScores(motion: readonly number[], music: readonly number[], tolerance: number): number[] {
  return motion.map((beat) => Math.exp(-(nearestDistance(music, beat) ** 2) / (2 * tolerance ** 2)));
}

/**
 * The shift of the music, at most two seconds, with the best beat alignment.
 * @param beats frames of the motion's beats; those before and after the music are ignored
 * @param music frames of the music's beats without a shift, ascending
 * @param tolerance as of `beatScores`
 * @returns null when there are too few beats to tell
 */
export function bestShift(
  beats: readonly number[],
  music: readonly number[],
  tolerance: number,
): BestShift | null {
  const [first = 0, last = 0] = [music[0], music.at(-1)];
  const motion = beats.filter((beat) => beat >= first - tolerance && beat <= last + tolerance);
  if (motion.length < MIN_BEATS || music.length < MIN_BEATS) return null;
  const shifts = Array.from({ length: 2 * MAX_SHIFT_FRAMES + 1 }, (_, index) => index - MAX_SHIFT_FRAMES);
  const scores = shifts.map((by) =>
    beatScores(
      motion.map((beat) => beat - by),
      music,
      tolerance,
    ),
  );
  const means = scores.map(mean);
  const best = Math.max(...means);
  const peaks = shifts.filter((_, index) => {
    const here = means[index] ?? 0;
    return here >= EQUAL_SHARE * best && here >= (means[index - 1] ?? 0) && here >= (means[index + 1] ?? 0);
  });
  const by = peaks.reduce((nearest, shift) => (Math.abs(shift) < Math.abs(nearest) ? shift : nearest));
  const [after = [], now = []] = [scores[by + MAX_SHIFT_FRAMES], scores[MAX_SHIFT_FRAMES]];
  const gains = after.map((score, beat) => score - (now[beat] ?? 0));
  const gain = mean(gains);
  const standardError = Math.sqrt(mean(gains.map((each) => (each - gain) ** 2)) / (gains.length - 1));
  const clear = gain >= MIN_GAIN && gain / Math.max(standardError, 1e-9) >= MIN_CONFIDENCE;
  return { by, score: mean(after), before: mean(now), clear };
}

/** Distance of a value to the nearest in an ascending list, by binary search; infinite for an empty list. */
function nearestDistance(ascending: readonly number[], value: number): number {
  let low = 0;
  let high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((ascending[middle] ?? Infinity) < value) low = middle + 1;
    else high = middle;
  }
  return Math.min(
    Math.abs((ascending[low] ?? Infinity) - value),
    Math.abs((ascending[low - 1] ?? -Infinity) - value),
  );
}
