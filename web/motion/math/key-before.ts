/**
 * The last key at or before a time, by binary search; not the last of all, so that another one follows it.
 * @param keys at least two, ascending, the first of them at or before `time`
 * @param timeOf the time of a key, which is the key itself if not given
 */
export function keyBefore<Key = number>(
  keys: ArrayLike<Key>,
  time: number,
  timeOf: (key: Key) => number = Number,
): number {
  let [low, high] = [0, keys.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (timeOf(keys[middle]!) <= time) low = middle;
    else high = middle;
  }
  return low;
}
