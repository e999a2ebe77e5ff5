/**
 * The value of a rank in ascending order, 0 for the least, in linear time (quickselect; Hoare 1961). Reorders the values
 * so that none after it is smaller.
 */
function select(values: Float64Array, rank: number): number | undefined {
  let [low, high] = [0, values.length - 1];
  while (low < high) {
    const [lowEnd, highStart] = partition(values, low, high);
    if (rank <= lowEnd) high = lowEnd;
    else if (rank >= highStart) low = highStart;
    else break;
  }
  return values[rank];
}

/**
 * Reorders the values from `low` to `high` about one of them.
 * @returns the last place of those that are not larger, and the first of those that are not smaller
 */
function partition(values: Float64Array, low: number, high: number): [number, number] {
  const pivot = values[(low + high) >> 1]!;
  let [i, j] = [low, high];
  while (i <= j) {
    while (values[i]! < pivot) i++;
    while (values[j]! > pivot) j--;
    if (i > j) break;
    const larger = values[i]!;
    values[i++] = values[j]!;
    values[j--] = larger;
  }
  return [j, i];
}

/**
 * Percentile of numbers, with linear interpolation between ranks, as numpy's default.
 * `share` is 0 to 100; an empty list gives NaN.
 */
export function percentile(values: ArrayLike<number>, share: number): number {
  const reordered = new Float64Array(values);
  const rank = ((reordered.length - 1) * share) / 100;
  const low = Math.floor(rank);
  const a = select(reordered, low) ?? Number.NaN;
  if (low === rank) return a;
  const b = reordered.subarray(low + 1).reduce((least, value) => Math.min(least, value), Infinity);
  return a + (b - a) * (rank - low);
}

export function median(values: ArrayLike<number>): number {
  return percentile(values, 50);
}

/** The mean; 0 of none. */
export function mean(values: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < values.length; i++) sum += values[i]!;
  return sum / Math.max(1, values.length);
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
  const reflected = new Float64Array(count + 2 * radius);
  for (let index = 0; index < reflected.length; index++) {
    const wrapped = (((index - radius) % (2 * count)) + 2 * count) % (2 * count);
    reflected[index] = values[wrapped < count ? wrapped : 2 * count - 1 - wrapped]!;
  }
  const filtered = new Float64Array(count);
  for (let index = 0; index < count; index++) {
    let sum = values[index]! * weights[0]!;
    for (let lag = radius; lag > 0; lag--)
      sum += (reflected[index + radius - lag]! + reflected[index + radius + lag]!) * weights[lag]!;
    filtered[index] = sum;
  }
  return filtered;
}

/** The largest value within `reach` samples before and after each one. */
export function windowMaximum(values: Float64Array, reach: number): Float64Array {
  return values.map((value, index) => {
    let most = value;
    const end = Math.min(values.length, index + reach + 1);
    for (let i = Math.max(0, index - reach); i < end; i++) most = Math.max(most, values[i]!);
    return most;
  });
}

/** The smallest value within `reach` samples before and after each one. */
export function windowMinimum(values: Float64Array, reach: number): Float64Array {
  return windowMaximum(
    values.map((value) => -value),
    reach,
  ).map((value) => -value);
}

/** Samples from `from` on, `to` excluded. */
export interface Run {
  readonly from: number;
  readonly to: number;
}

/** The runs in which flags are set; those with fewer than `pause` samples between them are one. */
export function runsOf(flags: readonly boolean[], pause = 1): Run[] {
  const runs: { from: number; to: number }[] = [];
  flags.forEach((flag, sample) => {
    if (!flag) return;
    const last = runs.at(-1);
    if (last && sample - last.to < pause) last.to = sample + 1;
    else runs.push({ from: sample, to: sample + 1 });
  });
  return runs;
}

/** The runs in which values are below `high` and somewhere below `low`: hysteresis thresholding, as in Canny 1986. */
export function runsBelow(values: Float64Array, low: number, high: number): Run[] {
  const runs = runsOf(Array.from(values, (value) => value < high));
  return runs.filter(({ from, to }) => values.subarray(from, to).some((value) => value < low));
}
