import { AppError } from '../common/error';
import { musicFeatures, type MusicFeatures } from './features';
import type { AudioRecipe } from './recipe';
import { resample } from './dsp/resample';
import { type Rhythm, rhythmOf } from './rhythm/rhythm';
import { encodeWav } from './wav';
import { type Waveform, waveformOf } from './waveform';

/** What is computed from the samples of a song. */
export interface Analysis extends Pick<MusicFeatures, 'frames' | 'features'> {
  /** What the page shows and counts; the model hears the beats that are among its features. */
  readonly rhythm: Rhythm;
  readonly waveform: Waveform;
  /** The decoded sound as a WAV file, for playing. */
  readonly sound: Blob;
  /** Whether no sample of the song is louder than -80 decibels. */
  readonly silent: boolean;
}

/** Share of the running time that mixing and resampling take, as measured; used for the progress only. */
const RESAMPLING_SHARE = 0.3;

/** Largest amplitude that is accepted: 60 decibels above full scale, far beyond any recording. */
const MAX_AMPLITUDE = 1000;

/** Largest amplitude of a silent song (full scale is 1): -80 decibels. */
const MAX_SILENT_AMPLITUDE = 1e-4;

/**
 * Mixes a decoded song to mono, resamples it and computes its features.
 *
 * @param channels samples of each channel at `sampleRate`, at least one channel and one sample
 * @param onProgress called with ascending fractions of the work done, the last one 1
 * @throws {AppError} `not-audio` where a sample is not finite or too loud
 */
export function analyse(
  channels: readonly Float32Array[],
  sampleRate: number,
  recipe: AudioRecipe,
  onProgress: (fraction: number) => void,
): Analysis {
  channels.forEach((channel) => checkSamples(channel, sampleRate));
  const pcm = resample(
    mixDown(channels, recipe.cancelled_share),
    sampleRate,
    recipe.sample_rate,
    (fraction) => onProgress(RESAMPLING_SHARE * fraction),
  );
  const { frames, features } = musicFeatures(pcm, recipe, (fraction) =>
    onProgress(RESAMPLING_SHARE + (1 - RESAMPLING_SHARE) * fraction),
  );
  const waveform = waveformOf(pcm, recipe.sample_rate);
  return {
    frames,
    features,
    rhythm: rhythmOf(features, recipe),
    waveform,
    sound: encodeWav(channels, sampleRate),
    silent: waveform.loudest <= MAX_SILENT_AMPLITUDE,
  };
}

/** @throws {AppError} not-audio */
function checkSamples(samples: Float32Array, sampleRate: number): void {
  // Written so that a sample that is not a number is found as well.
  const wrong = samples.findIndex((sample) => !(Math.abs(sample) <= MAX_AMPLITUDE));
  if (wrong < 0) return;
  throw new AppError(
    'not-audio',
    `The song is damaged at ${(wrong / sampleRate).toFixed(2)} seconds: what is there is not sound.`,
    'Open it in a sound editor and save it again, or choose another file.',
  );
}

/**
 * Mean of the channels, at least one; the first channel where they cancel each other out, as those of a song whose voice
 * was removed do: it can be heard, but its mean is silent. `mixed_down` of training/music/features.py.
 */
export function mixDown(channels: readonly Float32Array[], cancelledShare: number): Float32Array {
  const first = channels[0]!;
  const mono = new Float32Array(first.length);
  let [loudest, loudestOfFirst] = [0, 0];
  for (let i = 0; i < mono.length; i++) {
    let sum = 0;
    for (const channel of channels) sum += channel[i]!;
    mono[i] = sum / channels.length;
    loudest = Math.max(loudest, Math.abs(mono[i]!));
    loudestOfFirst = Math.max(loudestOfFirst, Math.abs(first[i]!));
  }
  return loudest < cancelledShare * loudestOfFirst ? first : mono;
}
