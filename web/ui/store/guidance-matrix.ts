import type { Manifest } from '../../model/client';
import { toStep } from './format';
import type { Guidance, Layer, Weights } from './reaction';

type Range = Pick<Manifest['guidance']['coarse'], 'min' | 'max' | 'step'>;

/** A matrix with the same value per layer in every stream. */
export function uniform(
  streams: readonly string[],
  layers: readonly string[],
  value: (layer: string) => number,
): Guidance {
  return Object.fromEntries(
    streams.map((stream) => [stream, Object.fromEntries(layers.map((layer) => [layer, value(layer)]))]),
  );
}

/** The manifest's default. */
export function defaultGuidance({ latent, guidance }: Pick<Manifest, 'latent' | 'guidance'>): Guidance {
  return uniform(latent.streams, latent.layers, (layer) => rangeOf(guidance, layer).default);
}

/** The weights that a layer can have: coarse for the first, fine for those above it. */
export function rangeOf(guidance: Manifest['guidance'], layer: string): Manifest['guidance']['coarse'] {
  return layer === 'coarse' ? guidance.coarse : guidance.fine;
}

/** Guidance of one layer in one stream; 0, the plain condition, where the matrix has none. */
export function guidanceAt(guidance: Guidance, stream: string, layer: string): number {
  return guidance[stream]?.[layer] ?? 0;
}

/** One layer over all streams: its mean, and whether the streams differ. */
export function columnOf(guidance: Guidance, layer: Layer): { value: number; mixed: boolean } {
  const values = Object.values(guidance).map((row) => row[layer] ?? 0);
  const sum = values.reduce((total, value) => total + value, 0);
  const mixed = values.some((value) => value !== values[0]);
  const mean = mixed ? sum / values.length : (values[0] ?? 0);
  return { value: Math.round(mean * 1e6) / 1e6, mixed };
}

export function sameGuidance(a: Guidance, b: Guidance): boolean {
  const cells = (guidance: Guidance): string[] =>
    Object.entries(guidance)
      .flatMap(([stream, row]) => Object.entries(row).map(([layer, value]) => `${stream} ${layer} ${value}`))
      .sort();
  const [one, other] = [cells(a), cells(b)];
  return one.length === other.length && one.every((cell, i) => cell === other[i]);
}

/** With one cell set, clamped to the range and rounded to the step. */
export function withCell(
  guidance: Guidance,
  stream: string,
  layer: string,
  value: number,
  range: Range,
): Guidance {
  return { ...guidance, [stream]: { ...guidance[stream], [layer]: clampedToStep(value, range) } };
}

/**
 * With one layer moved so that its mean over the streams is `value`. All streams move by the same amount and keep
 * their differences, except that each is clamped to the range.
 * @param from where they move from in this layer, when that is not where they are
 */
export function withColumn(
  guidance: Guidance,
  layer: Layer,
  value: number,
  range: Range,
  from = guidance,
): Guidance {
  const rows = Object.entries(guidance);
  const before = rows.map(([stream]) => guidanceAt(from, stream, layer));
  const by = shiftTo(before, Math.min(range.max, Math.max(range.min, value)), range);
  return Object.fromEntries(
    rows.map(([stream, row], i) => [
      stream,
      { ...row, [layer]: clampedToStep((before[i] ?? 0) + by, range) },
    ]),
  );
}

/** The amount to add to each value so that the mean of the clamped sums is `mean`, by bisection: it is monotonic. */
function shiftTo(values: readonly number[], mean: number, { min, max }: Range): number {
  const meanAfter = (by: number): number =>
    values.reduce((sum, value) => sum + Math.min(max, Math.max(min, value + by)), 0) / values.length;
  let [low, high] = [min - max, max - min];
  for (let iteration = 0; iteration < 50; iteration++) {
    const middle = (low + high) / 2;
    if (meanAfter(middle) < mean) low = middle;
    else high = middle;
  }
  return Math.round(high * 1e9) / 1e9;
}

export function clampedTo(value: number, { min, max }: Pick<Range, 'min' | 'max'>): number {
  return Math.min(max, Math.max(min, value));
}

/** The value, rounded to the step and clamped to the range, whose upper end may lie between two steps. */
export function clampedToStep(value: number, range: Range): number {
  return clampedTo(toStep(value, range.step, range.min), range);
}

/** `1.20 coarse, 0.60 fine, 3.00 music, 1.00 variety`, with `about` where the body parts differ. */
export function guidanceText({ guidance, music, variety }: Weights): string {
  const layers = (['coarse', 'fine'] as const).map((layer) => {
    const { value, mixed } = columnOf(guidance, layer);
    return `${mixed ? 'about ' : ''}${value.toFixed(2)} ${layer}`;
  });
  return [...layers, `${music.toFixed(2)} music`, `${variety.toFixed(2)} variety`].join(', ');
}
