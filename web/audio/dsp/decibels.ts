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
  const floor = 10 * Math.log10(Math.max(amin, maximum(power))) - zero - topDb;
  const decibels = new Float64Array(power.length);
  for (let i = 0; i < power.length; i++) {
    decibels[i] = Math.max(10 * Math.log10(Math.max(amin, power[i]!)) - zero, floor);
  }
  return decibels;
}

/** The largest of the values; -Infinity when there is none. */
export function maximum(values: Float64Array): number {
  let largest = -Infinity;
  for (const value of values) if (value > largest) largest = value;
  return largest;
}
