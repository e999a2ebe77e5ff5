/**
 * Windows of a running median, side by side. They hold values that are not negative, as the bits of float32: these
 * compare like the values, and integers can be compared without branches, which processors would often mispredict.
 *
 * A window is a half of lower values in any order, the median, and a half of higher values in any order. A value that
 * replaces another one in its own half changes nothing else. Otherwise the median fills the gap in the other half, and
 * the new median is the nearest among the new value and the values of its half.
 */
export interface MedianWindows {
  /** Values in a window, odd. */
  readonly kernel: number;
  /** windows x kernel */
  readonly values: Int32Array;
  /** windows x kernel: the place in its window of each slot's value */
  readonly places: Uint16Array;
  /** windows x kernel: the slot of the value at each place */
  readonly slots: Uint16Array;
}

/** Windows of zeros. */
export function medianWindows(count: number, kernel: number): MedianWindows {
  const places = Uint16Array.from({ length: count * kernel }, (_, i) => i % kernel);
  return { kernel, values: new Int32Array(count * kernel), places, slots: places.slice() };
}

/**
 * Replaces one value of a window.
 *
 * @param window which window
 * @param slot which of its values, 0 to kernel - 1
 * @returns the new median of the window
 */
export function replaceValue(windows: MedianWindows, window: number, slot: number, entering: number): number {
  const { kernel, values, places, slots } = windows;
  const start = window * kernel;
  const middle = start + ((kernel - 1) >> 1);
  const leaving = start + places[start + slot]!;
  const median = values[middle]!;
  const isHigher = entering >= median;
  if (isHigher ? leaving > middle : leaving < middle) {
    values[leaving] = entering;
    return median;
  }
  if (leaving !== middle) moveValue(windows, start, middle, leaving);
  const nearest = isHigher
    ? placeOfLeast(values, middle, start + kernel, entering)
    : placeOfGreatest(values, middle, start, entering);
  if (nearest !== middle) moveValue(windows, start, nearest, middle);
  values[nearest] = entering;
  slots[nearest] = slot;
  places[start + slot] = nearest - start;
  return values[middle]!;
}

/** Moves a value of the window that begins at `start`; places are indices into `values`. */
function moveValue({ values, places, slots }: MedianWindows, start: number, from: number, to: number): void {
  const slot = slots[from]!;
  values[to] = values[from]!;
  slots[to] = slot;
  places[start + slot] = to - start;
}

/** Place of the least value between `middle` and `end`, or `middle` if none is less than `limit`. */
function placeOfLeast(values: Int32Array, middle: number, end: number, limit: number): number {
  let least = limit;
  let place = middle;
  for (let i = middle + 1; i < end; i++) {
    const difference = values[i]! - least;
    const isLess = difference >> 31; // -1 where the difference is negative, else 0
    least += difference & isLess;
    place += (i - place) & isLess;
  }
  return place;
}

/** Place of the greatest value from `start` up to `middle`, or `middle` if none is greater than `limit`. */
function placeOfGreatest(values: Int32Array, middle: number, start: number, limit: number): number {
  let greatest = limit;
  let place = middle;
  for (let i = start; i < middle; i++) {
    const difference = greatest - values[i]!;
    const isGreater = difference >> 31;
    greatest -= difference & isGreater;
    place += (i - place) & isGreater;
  }
  return place;
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
 * @param values holds the row of `length` values from index `offset` on, as the bits of float32
 * @param windows one window, whatever it holds; its size is the width of the median
 * @param out receives the medians from index 0 on
 */
export function medianOfRow(
  values: Int32Array,
  offset: number,
  length: number,
  windows: MedianWindows,
  out: Int32Array,
): void {
  const { kernel } = windows;
  const half = (kernel - 1) / 2;
  for (let k = 0; k < kernel - 1; k++) {
    replaceValue(windows, 0, k, values[offset + reflectedIndex(k - half, length)]!);
  }
  let slot = kernel - 1;
  for (let i = 0; i < length; i++) {
    const index = i + half;
    const entering = values[offset + (index < length ? index : reflectedIndex(index, length))]!;
    out[i] = replaceValue(windows, 0, slot, entering);
    slot = slot + 1 === kernel ? 0 : slot + 1;
  }
}

/**
 * Replaces one slot of as many windows as there are medians.
 *
 * @param values holds the new values from index `offset` on
 * @param out receives the medians
 */
export function replaceRow(
  windows: MedianWindows,
  slot: number,
  values: Int32Array,
  offset: number,
  out: Int32Array,
): void {
  for (let window = 0; window < out.length; window++) {
    out[window] = replaceValue(windows, window, slot, values[offset + window]!);
  }
}
