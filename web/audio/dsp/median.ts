/**
 * Replaces one value of a sorted run by another and keeps the run sorted. Neighbouring windows of a median filter
 * differ by one value, and the new value is usually close to the old one, so this is faster than sorting each window.
 *
 * @param sorted holds the run of `size` ascending values from index `start` on; must contain `leaving`
 */
export function replaceSorted(
  sorted: Float32Array,
  start: number,
  size: number,
  leaving: number,
  entering: number,
): void {
  const last = start + size - 1;
  let low = start;
  let high = last;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (sorted[middle]! < leaving) low = middle + 1;
    else high = middle;
  }
  while (low < last && sorted[low + 1]! < entering) {
    sorted[low] = sorted[low + 1]!;
    low++;
  }
  while (low > start && sorted[low - 1]! > entering) {
    sorted[low] = sorted[low - 1]!;
    low--;
  }
  sorted[low] = entering;
}

/** Index into a signal of `length` values that is extended by reflection (d c b a | a b c d | d c b a). */
export function reflectedIndex(index: number, length: number): number {
  const period = 2 * length;
  const inPeriod = ((index % period) + period) % period;
  return inPeriod < length ? inPeriod : period - 1 - inPeriod;
}

/**
 * Running median of one row, extended by reflection (`scipy.ndimage.median_filter`, mode 'reflect').
 *
 * @param values holds the row of `length` values from index `offset` on
 * @param kernel odd width of the median
 * @param out receives the medians from index 0 on
 */
export function medianOfRow(
  values: Float32Array,
  offset: number,
  length: number,
  kernel: number,
  out: Float32Array,
): void {
  const half = (kernel - 1) / 2;
  const window = new Float32Array(kernel);
  for (let k = 0; k < kernel; k++) window[k] = values[offset + reflectedIndex(k - half, length)]!;
  window.sort();
  out[0] = window[half]!;
  for (let i = 1; i < length; i++) {
    const leaving = i - 1 - half;
    const entering = i + half;
    replaceSorted(
      window,
      0,
      kernel,
      values[offset + (leaving >= 0 ? leaving : reflectedIndex(leaving, length))]!,
      values[offset + (entering < length ? entering : reflectedIndex(entering, length))]!,
    );
    out[i] = window[half]!;
  }
}
