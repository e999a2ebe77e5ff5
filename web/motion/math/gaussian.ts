/** Standard deviations at which the filter is cut off, as scipy does. */
const CUT = 4;

/**
 * A Gaussian filter as `scipy.ndimage.gaussian_filter1d`, edges reflected. The sums run in scipy's order, so that two
 * equal values stay equal here where they do there, and no beat is seen in a motion that stands still.
 * @param deviation in values
 */
export function smoothed(values: Float64Array, deviation: number): Float64Array {
  const radius = Math.floor(CUT * deviation + 0.5);
  const raw = Array.from({ length: radius + 1 }, (_, far) => Math.exp((-0.5 * far * far) / deviation ** 2));
  const total = raw.reduce((sum, weight, far) => sum + (far === 0 ? weight : 2 * weight), 0);
  const weights = raw.map((weight) => weight / total);
  const count = values.length;
  const reflected = (index: number): number => {
    const round = ((index % (2 * count)) + 2 * count) % (2 * count);
    return values[round < count ? round : 2 * count - 1 - round]!;
  };
  return values.map((value, at) => {
    let sum = value * weights[0]!;
    for (let far = radius; far > 0; far--) sum += (reflected(at - far) + reflected(at + far)) * weights[far]!;
    return sum;
  });
}
