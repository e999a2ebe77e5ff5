import { fourier } from './fft';
import { type AudioRecipe, frameCount } from '../recipe';

/** A matrix of numbers over time: `frames` rows of `bins`. */
export interface Spectrogram {
  readonly frames: number;
  readonly bins: number;
  /** frames x bins */
  readonly values: Float32Array;
}

/** Hears of `done` of `total` units of work. */
export type Progress = (done: number, total: number) => void;

/**
 * Magnitudes of the short-time Fourier transform: periodic Hann window, frames centred on multiples of the hop, zeros
 * beyond both ends (`librosa.stft(center=True, pad_mode='constant')`).
 *
 * @param audio mono samples at the recipe's rate
 * @returns `frameCount` rows of n_fft / 2 + 1 magnitudes
 */
export function magnitudes(audio: Float32Array, recipe: AudioRecipe, progress?: Progress): Spectrogram {
  const size = recipe.n_fft;
  const frames = frameCount(audio.length, recipe);
  const bins = size / 2 + 1;
  const window = Float64Array.from(
    { length: size },
    (_, i) => 0.5 - 0.5 * Math.cos((2 * Math.PI * i) / size),
  );
  const values = new Float32Array(frames * bins);
  const windowed = new Float64Array(size);
  for (let frame = 0; frame < frames; frame++) {
    const start = frame * recipe.hop - size / 2;
    for (let i = 0; i < size; i++) windowed[i] = (audio[start + i] ?? 0) * window[i]!;
    const { real, imag } = fourier(windowed);
    for (let bin = 0; bin < bins; bin++) values[frame * bins + bin] = Math.hypot(real[bin]!, imag[bin]!);
    progress?.(frame + 1, frames);
  }
  return { frames, bins, values };
}
