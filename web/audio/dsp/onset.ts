import { powerToDecibels } from './decibels';
import type { AudioRecipe } from '../recipe';

/**
 * Onset strength: the median over the mel bands of the rise in decibels since `onset_lag` frames before, delayed by
 * half a window because a centred frame contains an onset half a window early (`librosa.onset.onset_strength`, aggregate
 * median).
 *
 * @param mel frames x mels powers
 * @returns one value per frame
 */
export function onsetStrength(mel: Float64Array, recipe: AudioRecipe): Float64Array {
  const { mels, onset_lag: lag } = recipe;
  const decibels = powerToDecibels(mel, 1, recipe.amin, recipe.top_db);
  const frames = mel.length / mels;
  const delay = Math.floor(recipe.n_fft / (2 * recipe.hop));
  const strength = new Float64Array(frames);
  const rises = new Float64Array(mels);
  for (let frame = lag; frame + delay < frames; frame++) {
    for (let band = 0; band < mels; band++) {
      const before = decibels[(frame - lag) * mels + band]!;
      rises[band] = Math.max(0, decibels[frame * mels + band]! - before);
    }
    strength[frame + delay] = sortedMedian(rises);
  }
  return strength;
}

/** Sorts the values, at least one, and returns their median: of an even number, the mean of the middle two. */
export function sortedMedian(values: Float64Array): number {
  values.sort();
  const middle = values.length >> 1;
  return values.length % 2 === 1 ? values[middle]! : (values[middle - 1]! + values[middle]!) / 2;
}
