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
    let largest = 0;
    for (let lag = 0; lag < size; lag++) {
      let sum = 0;
      for (let i = lag; i < size; i++) sum += local[i]! * local[i - lag]!;
      correlation[lag] = sum;
      largest = Math.max(largest, Math.abs(sum));
    }
    if (largest === 0) continue;
    for (let lag = 0; lag < size; lag++) mean[lag]! += correlation[lag]! / largest / onset.length;
  }
  return mean;
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
