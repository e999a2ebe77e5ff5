/**
 * Percentile of numbers, with linear interpolation between ranks, as numpy's default.
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

/** Standard deviations at which the filter is cut off, as scipy does. */
const TRUNCATE = 4;

/**
 * A Gaussian filter as `scipy.ndimage.gaussian_filter1d`, edges reflected. The sums run in scipy's order, so that values
 * that are equal there are equal here, and a motion that stands still has no motion beat.
 * @param deviation standard deviation, in samples
 */
export function gaussianFilter(values: Float64Array, deviation: number): Float64Array {
  const radius = Math.floor(TRUNCATE * deviation + 0.5);
  const raw = Array.from({ length: radius + 1 }, (_, lag) => Math.exp((-0.5 * lag * lag) / deviation ** 2));
  const total = raw.reduce((sum, weight, lag) => sum + (lag === 0 ? weight : 2 * weight), 0);
  const weights = raw.map((weight) => weight / total);
  const count = values.length;
  const reflected = (index: number): number => {
    const wrapped = ((index % (2 * count)) + 2 * count) % (2 * count);
    return values[wrapped < count ? wrapped : 2 * count - 1 - wrapped]!;
  };
  return values.map((value, index) => {
    let sum = value * weights[0]!;
    for (let lag = radius; lag > 0; lag--)
      sum += (reflected(index - lag) + reflected(index + lag)) * weights[lag]!;
    return sum;
  });
}
