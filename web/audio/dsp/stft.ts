import Meyda from 'meyda';
import { type AudioRecipe, frameCount } from '../recipe';

/** A matrix of numbers over time: `frames` rows of `bins`. */
export interface Spectrogram {
  readonly frames: number;
  readonly bins: number;
  /** frames x bins */
  readonly values: Float32Array;
}

/** Called when `done` of `total` units of work are done. */
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
    const { real, imag } = fft(windowed);
    for (let bin = 0; bin < bins; bin++) values[frame * bins + bin] = Math.hypot(real[bin]!, imag[bin]!);
    progress?.(frame + 1, frames);
  }
  return { frames, bins, values };
}

/** Real and imaginary parts of the bins 0 .. n - 1. */
interface ComplexSpectrum {
  readonly real: ArrayLike<number>;
  readonly imag: ArrayLike<number>;
}

/**
 * Fourier transform of a real frame whose length is a power of two. Meyda's own window is switched off, because it is
 * the symmetric Hann window and librosa's is the periodic one. Its settings are global, so they are set at every call.
 */
function fft(frame: Float64Array): ComplexSpectrum {
  Meyda.bufferSize = frame.length;
  Meyda.windowingFunction = 'rect';
  // Meyda accepts and returns doubles here, in spite of its declared type.
  return Meyda.extract('complexSpectrum', frame) as unknown as ComplexSpectrum;
}
