import { musicFeatures, type MusicFeatures } from './features';
import type { AudioRecipe } from './recipe';
import { resample } from './dsp/resample';
import { encodeWav } from './wav';

/** Everything that is computed from the samples of a song. */
export interface Analysis extends MusicFeatures {
  /** Mean of the channels at the recipe's rate. */
  readonly pcm: Float32Array;
  /** The decoded sound as a WAV file, for playing. */
  readonly sound: Blob;
  /** Whether nothing in the song is loud enough to be heard. */
  readonly silent: boolean;
}

/** Share of the running time that mixing and resampling take, measured; only the progress depends on it. */
const RESAMPLING_SHARE = 0.3;

/** Largest sample (full scale is 1) up to which a song counts as silent: -80 decibels. */
const SILENCE = 1e-4;

/**
 * Mixes, resamples and describes a decoded song.
 *
 * @param channels samples of each channel at `sampleRate`, at least one channel and one sample
 * @param onProgress hears ascending fractions of the work done, the last one 1
 */
export function analyse(
  channels: readonly Float32Array[],
  sampleRate: number,
  recipe: AudioRecipe,
  onProgress: (fraction: number) => void,
): Analysis {
  const pcm = resample(mixDown(channels), sampleRate, recipe.sample_rate, (fraction) =>
    onProgress(RESAMPLING_SHARE * fraction),
  );
  const music = musicFeatures(pcm, recipe, (fraction) =>
    onProgress(RESAMPLING_SHARE + (1 - RESAMPLING_SHARE) * fraction),
  );
  return {
    ...music,
    pcm,
    sound: encodeWav(channels, sampleRate),
    silent: pcm.every((sample) => Math.abs(sample) <= SILENCE),
  };
}

/** Mean of the channels. */
export function mixDown(channels: readonly Float32Array[]): Float32Array {
  const mono = new Float32Array(channels[0]?.length ?? 0);
  for (const channel of channels) {
    for (let i = 0; i < mono.length; i++) mono[i]! += channel[i]! / channels.length;
  }
  return mono;
}
