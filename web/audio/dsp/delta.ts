/**
 * Slope per frame of the line fitted to `width` frames around each frame; near the ends, of the first or last full
 * window (`librosa.feature.delta`, order 1, mode 'interp'). Zero when there are fewer frames than the window needs.
 *
 * @param values frames x columns
 * @param width odd
 * @returns frames x columns
 */
export function delta(values: Float64Array, columns: number, width: number): Float64Array {
  const out = new Float64Array(values.length);
  const frames = values.length / columns;
  if (frames < width) return out;
  const half = (width - 1) / 2;
  let norm = 0;
  for (let k = -half; k <= half; k++) norm += k * k;
  for (let frame = 0; frame < frames; frame++) {
    const centre = Math.min(Math.max(frame, half), frames - 1 - half);
    for (let column = 0; column < columns; column++) {
      let sum = 0;
      for (let k = 1; k <= half; k++) {
        sum += k * (values[(centre + k) * columns + column]! - values[(centre - k) * columns + column]!);
      }
      out[frame * columns + column] = sum / norm;
    }
  }
  return out;
}
