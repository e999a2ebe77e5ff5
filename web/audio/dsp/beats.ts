import { sortedMedian } from './onset';

/**
 * Beats by dynamic programming (Ellis 2007; `librosa.beat.beat_track` with trimming): the frames that lie on strong
 * onsets and about one period apart.
 *
 * @param onset onset strength per frame, not all zero
 * @param period frames per beat, a whole number
 * @param tightness how much a deviation from the period costs
 * @returns ascending frame numbers
 */
export function trackBeats(onset: Float64Array, period: number, tightness: number): number[] {
  const score = localScore(scaledToUnitDeviation(onset), period);
  const { previous, total } = bestSequences(score, period, tightness);
  const beats: number[] = [];
  for (let frame = lastBeat(total); frame >= 0; frame = previous[frame]!) beats.unshift(frame);
  return trimmed(beats, score);
}

function scaledToUnitDeviation(values: Float64Array): Float64Array {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const squares = values.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  const deviation = Math.sqrt(squares / (values.length - 1));
  return values.map((value) => value / (deviation + Number.MIN_VALUE));
}

/** The onset strength smoothed by a Gaussian of period / 32 frames. */
function localScore(onset: Float64Array, period: number): Float64Array {
  const kernel = Float64Array.from({ length: 2 * period + 1 }, (_, k) =>
    Math.exp(-0.5 * (((k - period) * 32) / period) ** 2),
  );
  return onset.map((_, frame) => {
    let sum = 0;
    const end = Math.min(frame + period, kernel.length);
    for (let k = Math.max(0, frame + period - onset.length + 1); k < end; k++) {
      sum += kernel[k]! * onset[frame + period - k]!;
    }
    return sum;
  });
}

/** For each frame, the best total score of a beat sequence that ends there, and the beat before it (-1: none). */
function bestSequences(
  score: Float64Array,
  period: number,
  tightness: number,
): { previous: Int32Array; total: Float64Array } {
  const previous = new Int32Array(score.length).fill(-1);
  const total = new Float64Array(score.length);
  const minDistance = roundHalfToEven(period / 2);
  const penalty = Float64Array.from(
    { length: 2 * period + 1 },
    (_, distance) => tightness * (Math.log(distance) - Math.log(period)) ** 2,
  );
  const threshold = 0.01 * score.reduce((largest, value) => Math.max(largest, value), 0);
  let started = false;
  for (let frame = 0; frame < score.length; frame++) {
    let best = -Infinity;
    let bestPrevious = -1;
    for (let distance = minDistance; distance <= 2 * period && distance <= frame; distance++) {
      const candidate = total[frame - distance]! - penalty[distance]!;
      if (candidate > best) [best, bestPrevious] = [candidate, frame - distance];
    }
    total[frame] = score[frame]! + (bestPrevious >= 0 ? best : 0);
    // A sequence begins at the first frame that isn't silent.
    if (started || score[frame]! >= threshold) {
      previous[frame] = bestPrevious;
      started = true;
    }
  }
  return { previous, total };
}

/** The last local maximum of the totals that reaches half of the median of all of them. */
function lastBeat(total: Float64Array): number {
  const last = total.length - 1;
  const isMaximum = (i: number): boolean =>
    i > 0 && total[i]! > total[i - 1]! && (i === last || total[i]! >= total[i + 1]!);
  const maxima = Array.from(total.keys()).filter(isMaximum);
  if (maxima.length === 0) return last;
  const threshold = 0.5 * sortedMedian(Float64Array.from(maxima, (i) => total[i]!));
  return maxima.findLast((i) => total[i]! >= threshold) ?? last;
}

/** Drops the beats before the first and after the last frame whose score exceeds half of the typical beat's. */
function trimmed(beats: readonly number[], score: Float64Array): number[] {
  const threshold =
    0.5 * rootMeanSquare(smoothed(beats.map((frame) => score[frame]!)).slice(0, score.length));
  const isLoud = (value: number): boolean => value > threshold;
  const first = score.findIndex(isLoud);
  const last = score.findLastIndex(isLoud);
  return beats.filter((frame) => first >= 0 && frame >= first && frame <= last);
}

/** The values convolved with [1/2, 1, 1/2]; two values longer, because librosa's slice of the convolution is. */
function smoothed(values: readonly number[]): number[] {
  return Array.from({ length: values.length + 2 }, (_, i) => {
    const [before, at, after] = [i - 1, i, i + 1].map((index) => values[index] ?? 0) as [
      number,
      number,
      number,
    ];
    return 0.5 * before + at + 0.5 * after;
  });
}

function rootMeanSquare(values: readonly number[]): number {
  return Math.sqrt(values.reduce((sum, value) => sum + value ** 2, 0) / values.length);
}

/** Rounds as numpy does: halves to the even neighbour. */
function roundHalfToEven(value: number): number {
  const below = Math.floor(value);
  return value - below === 0.5 ? below + (below % 2) : Math.round(value);
}
