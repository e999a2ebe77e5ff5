/**
 * Percentile of numbers with linear interpolation between ranks, as numpy's default.
 * `share` is 0 to 100; an empty list gives NaN.
 */
export function percentile(values: ArrayLike<number>, share: number): number {
  const sorted = Float64Array.from(values).sort();
  const rank = ((sorted.length - 1) * share) / 100;
  const low = Math.floor(rank);
  const a = sorted[low] ?? Number.NaN;
  const b = sorted[Math.min(low + 1, sorted.length - 1)] ?? Number.NaN;
  return a + (b - a) * (rank - low);
}

export function median(values: ArrayLike<number>): number {
  return percentile(values, 50);
}
