/** Farthest shift that is looked at, frames to either side. */
const REACH = 60;
/** Beats that are worth comparing at all. */
const FEWEST = 6;
/** A peak this close to the best one is as good; of such the nearest is taken, as beats come round again. */
const AS_GOOD = 0.98;
/** Gain of score, and gain over its standard error, from which on a shift is clearly better. */
const LEAST_GAIN = 0.1;
const LEAST_CONFIDENCE = 2;

/** The best place for the music. Scores go from 0 to 1, the mean over the motion beats while there is music. */
export interface BestShift {
  /** Frames by which the music has to start later. */
  readonly by: number;
  readonly score: number;
  /** The score as things are. */
  readonly before: number;
  /** The gain in units of its own standard error. */
  readonly confidence: number;
  /** Is it clearly better than what is? Among so many shifts one always looks a little better by accident. */
  readonly clear: boolean;
}

/**
 * How well each motion beat falls on the music: exp(-d^2 / (2 * tolerance^2)), d the frames to the nearest music beat, as
 * `beat_scores` of training/evaluation/metrics/beats.py with the motion's beats as reference.
 * @param motion frames in any order
 * @param music frames in ascending order, whole or not
 * @param tolerance standard deviation of the score, frames; the manifest's
 */
export function beatScores(motion: readonly number[], music: readonly number[], tolerance: number): number[] {
  return motion.map((beat) => Math.exp(-(distance(music, beat) ** 2) / (2 * tolerance ** 2)));
}

/**
 * The shift of the music, at most two seconds, that brings the motion's beats and its own together.
 * @param beats frames of the motion's beats; those in silence do not count
 * @param music frames of the music's beats as they are heard now, ascending
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
  if (motion.length < FEWEST || music.length < FEWEST) return null;
  const shifts = Array.from({ length: 2 * REACH + 1 }, (_, index) => index - REACH);
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
    return here >= AS_GOOD * best && here >= (means[index - 1] ?? 0) && here >= (means[index + 1] ?? 0);
  });
  const by = peaks.reduce((nearest, shift) => (Math.abs(shift) < Math.abs(nearest) ? shift : nearest));
  const [after = [], now = []] = [scores[by + REACH], scores[REACH]];
  const gains = after.map((score, beat) => score - (now[beat] ?? 0));
  const gain = mean(gains);
  const spread = Math.sqrt(mean(gains.map((each) => (each - gain) ** 2)) / (gains.length - 1));
  const confidence = gain / Math.max(spread, 1e-9);
  const clear = by !== 0 && gain >= LEAST_GAIN && confidence >= LEAST_CONFIDENCE;
  return { by, score: mean(after), before: mean(now), confidence, clear };
}

/** From a place to the nearest of the ascending ones; infinite where there is none. */
function distance(ascending: readonly number[], place: number): number {
  let low = 0;
  let high = ascending.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((ascending[middle] ?? Infinity) < place) low = middle + 1;
    else high = middle;
  }
  return Math.min(
    Math.abs((ascending[low] ?? Infinity) - place),
    Math.abs((ascending[low - 1] ?? -Infinity) - place),
  );
}

function mean(values: readonly number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);
}
