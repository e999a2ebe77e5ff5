import type { Accents } from './accents';

/**
 * How much the pitch classes of the `span` beats from each beat on differ from those of as many beats before it: 1 less
 * their cosine. Over a whole bar, passing notes and a bass that comes early weigh little.
 */
export function harmonyChanges(beats: readonly number[], { chroma, onset }: Accents, span: number): number[] {
  const pitches = chroma.length / Math.max(1, onset.length);
  const spectra = beats.map((beat, index) => {
    const sum = new Float64Array(pitches);
    const end = Math.min(onset.length, beats[index + 1] ?? onset.length);
    for (let frame = Math.max(0, Math.round(beat)); frame < end; frame++)
      for (let pitch = 0; pitch < pitches; pitch++) sum[pitch]! += chroma[frame * pitches + pitch]!;
    return sum;
  });
  return beats.map((_, beat) =>
    beat === 0
      ? 0
      : 1 -
        cosine(total(spectra.slice(Math.max(0, beat - span), beat)), total(spectra.slice(beat, beat + span))),
  );
}

/** The sum of vectors, at least one. */
function total(vectors: readonly Float64Array[]): Float64Array {
  return vectors[0]!.map((_, index) => vectors.reduce((sum, vector) => sum + vector[index]!, 0));
}

/** The cosine of the angle between two vectors; 0 where one is zero. */
function cosine(a: Float64Array, b: Float64Array): number {
  const product = (x: Float64Array, y: Float64Array): number =>
    x.reduce((sum, value, i) => sum + value * y[i]!, 0);
  const lengths = Math.sqrt(product(a, a) * product(b, b));
  return lengths > 0 ? product(a, b) / lengths : 0;
}
