/**
 * The last key at or before a time, by binary search; not the last of all, so that another one follows it.
 * @param times of the keys, at least two, ascending, the first of them at or before `time`
 */
export function keyBefore(times: ArrayLike<number>, time: number): number {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  return low;
}
