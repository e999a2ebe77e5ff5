import { type FilterBank, filterBank } from './filters';
import type { AudioRecipe } from '../recipe';

/** librosa starts its pitch classes at A; C is three semitones of twelve above. */
const SEMITONES_FROM_A_TO_C = 3;

/** Hz of the A below which octaves are counted from zero: A440 / 16. */
const A0_HZ = 440 / 16;

/**
 * Filters that sum a power spectrum into pitch classes, C first: Gaussians around every octave of the class,
 * weighted by a Gaussian over octaves (Ellis 2007; `librosa.filters.chroma`, norm 2).
 */
export function chromaFilters(recipe: AudioRecipe): FilterBank {
  const { chroma, n_fft: size } = recipe;
  const bins = size / 2 + 1;
  const positions = pitchPositions(recipe, bins + 1);
  const rows = Array.from({ length: chroma }, () => new Float64Array(bins));
  const gaussians = new Float64Array(chroma);
  for (let bin = 0; bin < bins; bin++) {
    const position = positions[bin]!;
    const width = Math.max(positions[bin + 1]! - position, 1);
    let norm = 0;
    for (let pitch = 0; pitch < chroma; pitch++) {
      const distance = (2 * wrap(position - pitch, chroma)) / width;
      const value = Math.exp(-0.5 * distance ** 2);
      gaussians[pitch] = value;
      norm += value ** 2;
    }
    const octaves = (position / chroma - recipe.chroma_octave) / recipe.chroma_octave_width;
    const weight = Math.exp(-0.5 * octaves ** 2) / Math.sqrt(norm);
    for (let pitch = 0; pitch < chroma; pitch++) {
      const fromC = (pitch - SEMITONES_FROM_A_TO_C * Math.floor(chroma / 12) + chroma) % chroma;
      rows[fromC]![bin] = gaussians[pitch]! * weight;
    }
  }
  return filterBank(rows);
}

/** Scales the row of `length` values from `offset` on so that its largest is 1; a row of zeros stays. */
export function normalizeRow(values: Float64Array, offset: number, length: number): void {
  let largest = 0;
  for (let i = offset; i < offset + length; i++) largest = Math.max(largest, values[i]!);
  if (largest === 0) return;
  for (let i = offset; i < offset + length; i++) values[i]! /= largest;
}

/** Pitch of the first `count` Fourier bins in pitch classes above A0. */
function pitchPositions(recipe: AudioRecipe, count: number): Float64Array {
  const reference = A0_HZ * 2 ** (recipe.chroma_tuning / recipe.chroma);
  const position = (bin: number): number =>
    recipe.chroma * Math.log2((bin * recipe.sample_rate) / recipe.n_fft / reference);
  // 0 Hz has no pitch: one and a half octaves below the first bin, so that it is spread over all classes.
  return Float64Array.from({ length: count }, (_, bin) =>
    bin === 0 ? position(1) - 1.5 * recipe.chroma : position(bin),
  );
}

/** Signed distance on a circle of `size` pitch classes. */
function wrap(distance: number, size: number): number {
  const half = Math.round(size / 2);
  return ((((distance + half) % size) + size) % size) - half;
}
