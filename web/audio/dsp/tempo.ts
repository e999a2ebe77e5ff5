import type { AudioRecipe } from '../recipe';

/**
 * The one tempo of a song: the lag at which the averaged local autocorrelation of the onset strength, weighted by a
 * log-normal prior, is largest (`librosa.feature.tempo`).
 *
 * @param onset one value per frame, not all zero
 * @returns frames per beat, a whole number
 */
export function beatPeriod(onset: Float64Array, recipe: AudioRecipe): number {
  const framesPerMinute = (60 * recipe.sample_rate) / recipe.hop;
  const size = Math.floor((recipe.tempo_window * recipe.sample_rate) / recipe.hop);
  const correlation = tempogram(onset, size);
  let best = 1;
  let bestScore = -Infinity;
  for (let lag = 1; lag < size; lag++) {
    const bpm = framesPerMinute / lag;
    if (bpm >= recipe.max_tempo) continue;
    const octaves = (Math.log2(bpm) - Math.log2(recipe.start_bpm)) / recipe.tempo_std;
    const score = Math.log1p(1e6 * correlation[lag]!) - 0.5 * octaves ** 2;
    if (score > bestScore) [best, bestScore] = [lag, score];
  }
  return best;
}

/**
 * Mean over all frames of the autocorrelation of the Hann-windowed onset strength around the frame, each scaled to a
 * largest value of 1 (`librosa.feature.tempogram`).
 *
 * @returns `size` values, lag 0 first
 */
function tempogram(onset: Float64Array, size: number): Float64Array {
  const padded = ramped(onset, Math.floor(size / 2));
  const window = Float64Array.from(
    { length: size },
    (_, i) => 0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size),
  );
  const mean = new Float64Array(size);
  const local = new Float64Array(size);
  const correlation = new Float64Array(size);
  for (let frame = 0; frame < onset.length; frame++) {
    for (let i = 0; i < size; i++) local[i] = window[i]! * padded[frame + i]!;
    autocorrelate(local, correlation);
    let largest = 0;
    for (let lag = 0; lag < size; lag++) largest = Math.max(largest, Math.abs(correlation[lag]!));
    if (largest === 0) continue;
    for (let lag = 0; lag < size; lag++) mean[lag]! += correlation[lag]! / largest / onset.length;
  }
  return mean;
}

/** Autocorrelation, lag 0 first. Four lags at a time, because they read the same values. */
function autocorrelate(values: Float64Array, out: Float64Array): void {
  for (let lag = 0; lag < values.length; lag += 4) {
    let sum0 = 0;
    let sum1 = 0;
    let sum2 = 0;
    let sum3 = 0;
    let before1 = 0;
    let before2 = 0;
    let before3 = 0;
    for (let i = lag; i < values.length; i++) {
      const value = values[i]!;
      const before0 = values[i - lag]!;
      sum0 += value * before0;
      sum1 += value * before1;
      sum2 += value * before2;
      sum3 += value * before3;
      before3 = before2;
      before2 = before1;
      before1 = before0;
    }
    out[lag] = sum0;
    if (lag + 1 < out.length) out[lag + 1] = sum1;
    if (lag + 2 < out.length) out[lag + 2] = sum2;
    if (lag + 3 < out.length) out[lag + 3] = sum3;
  }
}

/** The signal with `margin` values at each end that lead linearly from zero to it (numpy's linear_ramp padding). */
function ramped(signal: Float64Array, margin: number): Float64Array {
  const out = new Float64Array(signal.length + 2 * margin);
  out.set(signal, margin);
  const [first, last] = [signal[0]!, signal[signal.length - 1]!];
  for (let i = 0; i < margin; i++) {
    out[i] = (first * i) / margin;
    out[out.length - 1 - i] = (last * i) / margin;
  }
  return out;
}
