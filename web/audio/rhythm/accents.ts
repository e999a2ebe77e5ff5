import type { AudioRecipe } from '../recipe';

/** How strongly something begins at each frame of a song, in three parts of the music. */
export interface Accents {
  readonly framesPerSecond: number;
  /** Of the whole sound: unit mean square around each frame, mean zero. */
  readonly onset: Float64Array;
  /** Rise of the lowest bands, decibels. */
  readonly bass: Float64Array;
  /** Pitch classes, frames x chroma, each between 0 and 1. */
  readonly chroma: Float64Array;
}

/** Bands of the mel spectrum that is computed back from the cepstrum, which holds no finer detail. */
const BANDS = 16;
/** The lowest bands, which hold bass and bass drum: about 350 Hz. */
const BASS_BANDS = 2;
/** Weight of the bass beside that of each other part. */
const BASS_WEIGHT = 0.5;
/** Seconds to either side over which loudness is levelled. */
const LEVELLING = 4;

/**
 * The accents of a song, from the features that the model reads: the onset strength of percussion, and beside it the
 * rise of the whole spectrum, because strings, voices and organs have onsets that are no percussion, and that of the
 * bass, which tells beats from offbeats.
 *
 * @param features frames x recipe.features
 */
export function accentsOf(features: Float32Array, recipe: AudioRecipe): Accents {
  const { mfcc, chroma: pitches, features: width } = recipe;
  const frames = features.length / width;
  const framesPerSecond = recipe.sample_rate / recipe.hop;
  // As the onset strength is: a centred frame contains an onset half a window early.
  const delay = Math.floor(recipe.n_fft / (2 * recipe.hop));
  const toBands = inverseTransform(recipe);
  const rise = new Float64Array(frames);
  const bass = new Float64Array(frames);
  const chroma = new Float64Array(frames * pitches);
  const onset = new Float64Array(frames);
  let before: Float64Array | null = null;
  for (let frame = 0; frame < frames; frame++) {
    const row = features.subarray(frame * width, (frame + 1) * width);
    chroma.set(row.subarray(2 * mfcc, 2 * mfcc + pitches), frame * pitches);
    onset[frame] = row[2 * mfcc + pitches]!;
    const bands = toBands(row);
    if (before && frame + delay < frames) {
      const rises = bands.map((level, band) => Math.max(0, level - before![band]!));
      rise[frame + delay] = rises.reduce((sum, value) => sum + value, 0) / BANDS;
      bass[frame + delay] = rises.subarray(0, BASS_BANDS).reduce((sum, value) => sum + value, 0) / BASS_BANDS;
    }
    before = bands;
  }
  const [percussive, whole, low] = [scale(onset), scale(rise), scale(bass)];
  const sum = onset.map(
    (value, frame) => percussive * value + whole * rise[frame]! + BASS_WEIGHT * low * bass[frame]!,
  );
  return { framesPerSecond, onset: levelled(smoothed(sum), LEVELLING * framesPerSecond), bass, chroma };
}

/** The largest value within a frame of a moment, given in frames. */
export function strongest(values: Float64Array, moment: number): number {
  const frame = Math.round(moment);
  return Math.max(...[frame - 1, frame, frame + 1].map((at) => values[at] ?? 0));
}

/** Decibels in the bands from a cepstrum: the inverse of the orthonormal cosine transform at the bands' middles. */
function inverseTransform({ mfcc, mels }: AudioRecipe): (cepstrum: Float32Array) => Float64Array {
  const cosines = Float64Array.from({ length: BANDS * mfcc }, (_, index) => {
    const [band, k] = [Math.floor(index / mfcc), index % mfcc];
    return Math.sqrt((k === 0 ? 1 : 2) / mels) * Math.cos((Math.PI * k * (band + 0.5)) / BANDS);
  });
  return (cepstrum) =>
    Float64Array.from({ length: BANDS }, (_, band) => {
      let sum = 0;
      for (let k = 0; k < mfcc; k++) sum += cosines[band * mfcc + k]! * cepstrum[k]!;
      return sum;
    });
}

/** The factor that gives values a mean of 1; 0 for zeros. */
function scale(values: Float64Array): number {
  const sum = values.reduce((all, value) => all + value, 0);
  return sum > 0 ? values.length / sum : 0;
}

/** The values convolved with [1/4, 1/2, 1/4], so that a beat between two frames counts as one on a frame. */
function smoothed(values: Float64Array): Float64Array {
  return values.map(
    (value, frame) => 0.25 * (values[frame - 1] ?? value) + 0.5 * value + 0.25 * (values[frame + 1] ?? value),
  );
}

/** The values less their mean and divided by their root mean square, both over `radius` frames to either side. */
function levelled(values: Float64Array, radius: number): Float64Array {
  const sums = new Float64Array(values.length + 1);
  const squares = new Float64Array(values.length + 1);
  values.forEach((value, frame) => {
    sums[frame + 1] = sums[frame]! + value;
    squares[frame + 1] = squares[frame]! + value ** 2;
  });
  const whole = squares[values.length]! / Math.max(1, values.length);
  return values.map((value, frame) => {
    const first = Math.max(0, Math.round(frame - radius));
    const end = Math.min(values.length, Math.round(frame + radius) + 1);
    const mean = (sums[end]! - sums[first]!) / (end - first);
    const variance = (squares[end]! - squares[first]!) / (end - first) - mean ** 2;
    // A quiet passage is raised, silence and its noise are not.
    return (value - mean) / Math.sqrt(variance + 0.02 * whole + Number.MIN_VALUE);
  });
}
