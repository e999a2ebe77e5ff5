import Meyda from 'meyda';

/** Real and imaginary parts of the bins 0 .. n - 1. */
export interface ComplexSpectrum {
  readonly real: ArrayLike<number>;
  readonly imag: ArrayLike<number>;
}

/**
 * Fourier transform of a real frame whose length is a power of two. The frame is transformed as it is: Meyda's own
 * window is switched off, because it is the symmetric Hann window and librosa's is the periodic one.
 *
 * The only place that knows Meyda. Its settings are globals of its module, so they are set at every call.
 */
export function fourier(frame: Float64Array): ComplexSpectrum {
  Meyda.bufferSize = frame.length;
  Meyda.windowingFunction = 'rect';
  // Doubles in, doubles out: Meyda copies a typed array as it is, in spite of its declared type.
  return Meyda.extract('complexSpectrum', frame) as unknown as ComplexSpectrum;
}
