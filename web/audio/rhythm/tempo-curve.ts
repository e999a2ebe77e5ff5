/** The tempo at each moment of a song. */
export interface TempoCurve {
  /** Frames a beat, at each frame of the song. */
  readonly periods: Float64Array;
  /** How much the onsets repeat at that period: 1 is a metronome, noise is near 0. */
  readonly clarity: number;
}

/** Range of tempi, beats per minute. */
const SLOWEST = 50;
const FASTEST = 220;
/** Ratio of two neighbouring tempi. */
const STEP = 1.015;
/** Tempo that people most readily tap to, beats per minute, and how far they go from it, octaves. */
const PREFERRED = 136;
const PREFERENCE_OCTAVES = 1.2;
/** Length of a window and distance of two, seconds. */
const WINDOW = 9;
const HOP = 0.5;
/** Multiples of the period at which onsets repeat. */
const REPEATS = 4;
/** Cost of a change of tempo between two windows: of each step, and at most. */
const STEP_COST = 0.16;
const JUMP_COST = 6;

/**
 * The tempo by the autocorrelation of the onsets in windows, at one to four periods, followed through the song by
 * dynamic programming, so that it may change slowly, or at once where the music does.
 *
 * @param onset mean zero
 */
export function tempoCurve(onset: Float64Array, framesPerSecond: number): TempoCurve {
  const count = Math.floor(Math.log(FASTEST / SLOWEST) / Math.log(STEP)) + 1;
  const tempi = Array.from({ length: count }, (_, index) => SLOWEST * STEP ** index);
  const periods = tempi.map((tempo) => (60 * framesPerSecond) / tempo);
  const preference = tempi.map((tempo) =>
    Math.exp(-0.5 * (Math.log2(tempo / PREFERRED) / PREFERENCE_OCTAVES) ** 2),
  );
  const size = Math.round(WINDOW * framesPerSecond);
  const shape = windowOf(size, Math.min(size - 1, Math.ceil(REPEATS * periods[0]!) + 2));
  const hop = Math.max(1, Math.round(HOP * framesPerSecond));
  const windows = Math.max(1, Math.ceil(onset.length / hop));
  const repeats = Array.from({ length: windows }, (_, index) => {
    const correlation = autocorrelation(onset, Math.round((index + 0.5) * hop - size / 2), shape);
    return periods.map((period) => repetition(correlation, period));
  });
  const path = bestPath(repeats.map((row) => row.map((value, tempo) => value * preference[tempo]!)));
  const along = path.map((tempo, window) => repeats[window]![tempo]!);
  return {
    periods: Float64Array.from(onset, (_, frame) => {
      const at = Math.min(windows - 1, Math.max(0, frame / hop - 0.5));
      const before = Math.floor(at);
      const [from, to] = [path[before]!, path[Math.min(windows - 1, before + 1)]!];
      // Between two windows the tempo is halfway, unless it jumps.
      const near =
        Math.abs(from - to) <= 4 ? from + (to - from) * (at - before) : at - before < 0.5 ? from : to;
      return (60 * framesPerSecond) / (SLOWEST * STEP ** near);
    }),
    clarity: along.reduce((sum, value) => sum + value, 0) / along.length,
  };
}

/** Autocorrelation of a part of the onsets under a window, 1 at lag 0; zeros for silence. */
function autocorrelation(onset: Float64Array, start: number, { shape, gains }: Window): Float64Array {
  const values = shape.map((weight, i) => weight * (onset[start + i] ?? 0));
  const power = product(values, 0);
  if (power < 1e-9) return new Float64Array(gains.length);
  return gains.map((gain, lag) => (gain * product(values, lag)) / power);
}

interface Window {
  /** A sine arch, whose square is the Hann window. */
  readonly shape: Float64Array;
  /** What undoes the loss of each lag to the window. */
  readonly gains: Float64Array;
}

function windowOf(size: number, lags: number): Window {
  const shape = Float64Array.from({ length: size }, (_, i) => Math.sin((Math.PI * (i + 0.5)) / size));
  const power = product(shape, 0);
  return { shape, gains: Float64Array.from({ length: lags }, (_, lag) => power / product(shape, lag)) };
}

/** Sum of the products of the values with those `lag` before. */
function product(values: Float64Array, lag: number): number {
  let sum = 0;
  for (let i = lag; i < values.length; i++) sum += values[i]! * values[i - lag]!;
  return sum;
}

/** Mean of the autocorrelation at one to four periods, read between the lags. */
function repetition(correlation: Float64Array, period: number): number {
  let sum = 0;
  for (let k = 1; k <= REPEATS; k++) {
    const lag = Math.floor(k * period);
    const part = k * period - lag;
    sum += (1 - part) * (correlation[lag] ?? 0) + part * (correlation[lag + 1] ?? 0);
  }
  return sum / REPEATS;
}

/** The column of each row that makes the sum of the values, less the cost of changes, largest (Viterbi). */
function bestPath(rows: readonly (readonly number[])[]): number[] {
  const from: Int32Array[] = [];
  let total = Float64Array.from(rows[0]!);
  for (const row of rows.slice(1)) {
    const best = total.indexOf(Math.max(...total));
    const reach = Math.ceil(JUMP_COST / STEP_COST);
    const origin = new Int32Array(row.length);
    total = Float64Array.from(row, (value, to) => {
      let [sum, at] = [total[best]! - JUMP_COST, best];
      for (let before = Math.max(0, to - reach); before <= Math.min(row.length - 1, to + reach); before++) {
        const candidate = total[before]! - STEP_COST * Math.abs(to - before);
        if (candidate > sum) [sum, at] = [candidate, before];
      }
      origin[to] = at;
      return sum + value;
    });
    from.push(origin);
  }
  const path = [total.indexOf(Math.max(...total))];
  for (const origin of from.toReversed()) path.unshift(origin[path[0]!]!);
  return path;
}
