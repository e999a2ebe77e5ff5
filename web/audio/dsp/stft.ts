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
export function magnitudes(audio: Float32Array, recipe: AudioRecipe, progress: Progress): Spectrogram {
  const size = recipe.n_fft;
  const half = size / 2;
  const frames = frameCount(audio.length, recipe);
  const bins = half + 1;
  const angle = (index: number): number => (2 * Math.PI * index) / size;
  const window = Float64Array.from({ length: size }, (_, i) => 0.5 - 0.5 * Math.cos(angle(i)));
  const cosines = Float64Array.from({ length: bins }, (_, bin) => Math.cos(angle(bin)));
  const sines = Float64Array.from({ length: bins }, (_, bin) => Math.sin(angle(bin)));
  const values = new Float32Array(frames * bins);
  const padded = new Float32Array(audio.length + 2 * size);
  padded.set(audio, half);
  const even = new Float64Array(half);
  const odd = new Float64Array(half);
  for (let frame = 0; frame < frames; frame++) {
    applyWindow(padded, frame * recipe.hop, window, even, odd);
    const { real, imag } = fft(even, odd);
    writeMagnitudes(real, imag, cosines, sines, values, frame * bins);
    progress(frame + 1, frames);
  }
  return { frames, bins, values };
}

/** Windows the samples from index `start` on, and separates those at even from those at odd distances from it. */
function applyWindow(
  samples: Float32Array,
  start: number,
  window: Float64Array,
  even: Float64Array,
  odd: Float64Array,
): void {
  for (let i = 0; i < even.length; i++) {
    even[i] = samples[start + 2 * i]! * window[2 * i]!;
    odd[i] = samples[start + 2 * i + 1]! * window[2 * i + 1]!;
  }
}

/**
 * Magnitudes of a real signal's spectrum, from the transform of its samples in pairs as complex numbers, which takes
 * half as long as a transform of the samples (Press et al., Numerical Recipes, 12.3.2).
 *
 * @param real real parts of the transform of n / 2 pairs
 * @param imag imaginary parts
 * @param cosines of 2 pi k / n, for each bin k
 * @param sines of the same angles
 * @param out receives the n / 2 + 1 magnitudes from index `offset` on
 */
function writeMagnitudes(
  real: Float64Array,
  imag: Float64Array,
  cosines: Float64Array,
  sines: Float64Array,
  out: Float32Array,
  offset: number,
): void {
  const half = real.length;
  for (let bin = 0; 2 * bin <= half; bin++) {
    const mirrored = bin === 0 ? 0 : half - bin;
    // Twice the spectra of the even and of the odd samples; the latter's turned by half a sample.
    const evenReal = real[bin]! + real[mirrored]!;
    const evenImag = imag[bin]! - imag[mirrored]!;
    const oddReal = imag[bin]! + imag[mirrored]!;
    const oddImag = real[mirrored]! - real[bin]!;
    const turnedReal = cosines[bin]! * oddReal + sines[bin]! * oddImag;
    const turnedImag = cosines[bin]! * oddImag - sines[bin]! * oddReal;
    out[offset + bin] = 0.5 * Math.sqrt((evenReal + turnedReal) ** 2 + (evenImag + turnedImag) ** 2);
    out[offset + half - bin] = 0.5 * Math.sqrt((evenReal - turnedReal) ** 2 + (evenImag - turnedImag) ** 2);
  }
}

/** Real and imaginary parts of the bins 0 .. n - 1. */
interface ComplexSpectrum {
  readonly real: Float64Array;
  readonly imag: Float64Array;
}

/**
 * Fourier transform of a complex signal whose length is a power of two. Meyda's transform takes one when the signal
 * has its parts as `real` and `imag`, which Meyda's declarations don't tell. Its window is switched off, because it is
 * the symmetric Hann window and librosa's is the periodic one. Its settings are global, so they are set at every call.
 */
function fft(real: Float64Array, imag: Float64Array): ComplexSpectrum {
  Meyda.bufferSize = real.length;
  Meyda.windowingFunction = 'rect';
  const signal = { length: real.length, buffer: real.buffer, real, imag };
  return Meyda.extract('complexSpectrum', signal as unknown as Float32Array) as unknown as ComplexSpectrum;
}
