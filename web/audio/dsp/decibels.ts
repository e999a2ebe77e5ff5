/**
 * Powers as decibels above `reference`, nothing more than `topDb` below the loudest (`librosa.power_to_db`).
 *
 * @param amin least power: smaller ones, also a smaller reference, are replaced by it
 */
export function powerToDecibels(
  power: Float64Array,
  reference: number,
  amin: number,
  topDb: number,
): Float64Array {
  const zero = 10 * Math.log10(Math.max(amin, reference));
  const decibels = power.map((value) => 10 * Math.log10(Math.max(amin, value)) - zero);
  const floor = maximum(decibels) - topDb;
  return decibels.map((value) => Math.max(value, floor));
}

/** The largest of the values; -Infinity when there is none. */
export function maximum(values: Float64Array): number {
  let largest = -Infinity;
  for (const value of values) if (value > largest) largest = value;
  return largest;
}
