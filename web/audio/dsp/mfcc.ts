import { maximum, powerToDecibels } from './decibels';
import type { AudioRecipe } from '../recipe';

/**
 * Mel-frequency cepstral coefficients: the orthonormal DCT-II of the mel spectrum in decibels below the loudest value
 * of the whole song (`librosa.feature.mfcc`).
 *
 * @param mel frames x mels powers
 * @returns frames x mfcc
 */
export function cepstrum(mel: Float64Array, recipe: AudioRecipe): Float64Array {
  const { mels, mfcc } = recipe;
  const decibels = powerToDecibels(mel, maximum(mel), recipe.amin, recipe.top_db);
  const basis = cosines(mels, mfcc);
  const frames = mel.length / mels;
  const out = new Float64Array(frames * mfcc);
  for (let frame = 0; frame < frames; frame++) {
    for (let k = 0; k < mfcc; k++) {
      let sum = 0;
      for (let band = 0; band < mels; band++) sum += basis[k * mels + band]! * decibels[frame * mels + band]!;
      out[frame * mfcc + k] = sum;
    }
  }
  return out;
}

/** The first `count` rows of the orthonormal DCT-II of length `size`: count x size. */
function cosines(size: number, count: number): Float64Array {
  return Float64Array.from({ length: count * size }, (_, index) => {
    const k = Math.floor(index / size);
    const scale = Math.sqrt((k === 0 ? 1 : 2) / size);
    return scale * Math.cos((Math.PI * k * (2 * (index % size) + 1)) / (2 * size));
  });
}
