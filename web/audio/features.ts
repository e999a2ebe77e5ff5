import { trackBeats } from './dsp/beats';
import { chromaFilters, normalizeRow } from './dsp/chroma';
import { delta } from './dsp/delta';
import { applyFilters, powers } from './dsp/filters';
import { separateHarmonicPercussive } from './dsp/hpss';
import { melFilters } from './dsp/mel';
import { cepstrum } from './dsp/mfcc';
import { onsetStrength } from './dsp/onset';
import { type AudioRecipe, frameCount } from './recipe';
import { magnitudes } from './dsp/stft';
import { beatPeriod } from './dsp/tempo';

/** The features of a song that the model is conditioned on. */
export interface MusicFeatures {
  readonly frames: number;
  /** frames x recipe.features: MFCC, their deltas, chroma, onset strength, beat */
  readonly features: Float32Array;
}

/** Shares of the running time, as measured on a three-minute song; used for the progress only. */
const SPECTRUM_SHARE = 0.35;
const SEPARATION_SHARE = 0.45;

/**
 * The music features of a whole song, as training/music/features.py computes them with librosa 0.11.
 *
 * @param audio mono samples at the recipe's rate; may be shorter than a window, digital silence gives zeros
 * @param onProgress called about a hundred times with the fraction of the work done, the last time with 1
 */
export function musicFeatures(
  audio: Float32Array,
  recipe: AudioRecipe,
  onProgress: (fraction: number) => void = () => undefined,
): MusicFeatures {
  const { mels, mfcc, chroma } = recipe;
  const frames = frameCount(audio.length, recipe);
  const report = (base: number, share: number) => (done: number, total: number) => {
    if (done % Math.ceil(total / 50) === 0) onProgress(base + (share * done) / total);
  };

  const spectrogram = magnitudes(audio, recipe, report(0, SPECTRUM_SHARE));
  const melBank = melFilters(recipe);
  const chromaBank = chromaFilters(recipe);
  const mel = new Float64Array(frames * mels);
  const percussiveMel = new Float64Array(frames * mels);
  const pitches = new Float64Array(frames * chroma);
  const power = new Float64Array(spectrogram.bins);
  separateHarmonicPercussive(
    spectrogram,
    recipe,
    (frame, harmonic, percussive) => {
      powers(spectrogram.values, frame * spectrogram.bins, power);
      applyFilters(melBank, power, mel, frame * mels);
      applyFilters(melBank, percussive, percussiveMel, frame * mels);
      applyFilters(chromaBank, harmonic, pitches, frame * chroma);
      normalizeRow(pitches, frame * chroma, chroma);
    },
    report(SPECTRUM_SHARE, SEPARATION_SHARE),
  );

  const cepstra = cepstrum(mel, recipe);
  const onset = onsetStrength(percussiveMel, recipe);
  const beats = new Float64Array(frames);
  if (onset.some((value) => value !== 0))
    for (const frame of trackBeats(onset, beatPeriod(onset, recipe), recipe.tightness)) beats[frame] = 1;

  const features = interleave(frames, recipe.features, [
    { values: cepstra, columns: mfcc },
    { values: delta(cepstra, mfcc, recipe.delta_width), columns: mfcc },
    { values: pitches, columns: chroma },
    { values: onset, columns: 1 },
    { values: beats, columns: 1 },
  ]);
  onProgress(1);
  return { frames, features };
}

/** Puts blocks of columns side by side: frames x width. */
function interleave(
  frames: number,
  width: number,
  blocks: readonly { values: Float64Array; columns: number }[],
): Float32Array {
  const out = new Float32Array(frames * width);
  let first = 0;
  for (const { values, columns } of blocks) {
    for (let frame = 0; frame < frames; frame++) {
      out.set(values.subarray(frame * columns, (frame + 1) * columns), frame * width + first);
    }
    first += columns;
  }
  if (first !== width)
    throw new RangeError(`the recipe promises ${width} feature columns and makes ${first}`);
  return out;
}
