/** A low-pass filter: a sinc function under a Kaiser window. */
interface Filter {
  /** Edge of the pass band at half amplitude, relative to half the lower rate. */
  readonly cutoff: number;
  /** Shape parameter of the Kaiser window. */
  readonly beta: number;
  /** Half the length of the window, in samples at the lower rate. */
  readonly halfLength: number;
}

/**
 * The filter of soxr's 'HQ' quality, which librosa resamples with, fitted to its impulse response to 6e-5 of the peak.
 * Browsers resample with shorter filters, which change the highest mel bands by a third of a standard deviation; that
 * is why songs are decoded at a high rate and resampled here.
 */
const SOXR: Filter = { cutoff: 0.9568586, beta: 14.6532, halfLength: 105.279 };

/**
 * The filter that halves the rate: it removes the frequencies that would alias into those that are kept. Its cutoff of
 * 1 makes the weights zero at all even distances but 0 (a half-band filter).
 */
const HALVING: Filter = { cutoff: 1, beta: 12.27, halfLength: 12 };

/** About so many outputs are computed in one go, so that what they need stays in the processor's cache. */
const BLOCK = 2 ** 15;

/**
 * Resamples to a lower rate like `librosa.resample` does (linear phase, no delay).
 *
 * @param from Hz, whole
 * @param to Hz, whole, at most `from`
 * @param onProgress called with ascending fractions of the work done
 * @returns ceil(samples * to / from) samples
 */
export function resample(
  audio: Float32Array,
  from: number,
  to: number,
  onProgress: (fraction: number) => void = () => undefined,
): Float32Array {
  if (from === to) return audio;
  const length = Math.ceil((audio.length * to) / from);
  if (from < 3 * to || from % 2 === 1) return convert(audio, 0, length, from, to, onProgress);
  // From a much higher rate, a short filter halves the rate first, which leaves half the work for the long filter. The
  // margin holds what the short filter spreads over the ends.
  const margin = HALVING.halfLength;
  return convert(halve(audio, margin), margin, length, from / 2, to, onProgress);
}

/**
 * Halves the rate.
 *
 * @returns samples at the lower rate, `margin` of them before the first and as many after the last of the signal
 */
function halve(signal: Float32Array, margin: number): Float32Array {
  const reach = 2 * HALVING.halfLength;
  const weights = Float64Array.from({ length: reach / 2 }, (_, i) => kernel(2 * i + 1, 2, 1, HALVING));
  const out = new Float32Array(Math.ceil(signal.length / 2) + 2 * margin);
  const samples = new Float64Array(2 * (BLOCK + reach));
  const block = new Float32Array(BLOCK);
  for (let first = 0; first < out.length; first += BLOCK) {
    copyWithZeros(signal, 2 * (first - margin) - reach, samples);
    filterHalfBand(weights, samples, reach, block);
    out.set(block.subarray(0, out.length - first), first);
  }
  return out;
}

/**
 * Computes outputs at every other sample, four at once, which reads each weight once for all of them.
 *
 * @param weights those of samples at distance 1, 3, 5 ..; the output's own sample has half, the others none
 * @param middle index of the first output's sample
 * @param out its length is a multiple of four
 */
function filterHalfBand(
  weights: Float64Array,
  samples: Float64Array,
  middle: number,
  out: Float32Array,
): void {
  for (let i = 0; i < out.length; i += 4) {
    const first = middle + 2 * i;
    let a = 0.5 * samples[first]!;
    let b = 0.5 * samples[first + 2]!;
    let c = 0.5 * samples[first + 4]!;
    let d = 0.5 * samples[first + 6]!;
    for (let k = 0; k < weights.length; k++) {
      const weight = weights[k]!;
      const left = first - 1 - 2 * k;
      const right = first + 1 + 2 * k;
      a += weight * (samples[left]! + samples[right]!);
      b += weight * (samples[left + 2]! + samples[right + 2]!);
      c += weight * (samples[left + 4]! + samples[right + 4]!);
      d += weight * (samples[left + 6]! + samples[right + 6]!);
    }
    out[i] = a;
    out[i + 1] = b;
    out[i + 2] = c;
    out[i + 3] = d;
  }
}

/**
 * Filters and resamples by a rational factor, one precomputed filter for each position between two samples.
 *
 * @param origin index of the sample at which the first output lies
 */
function convert(
  signal: Float32Array,
  origin: number,
  length: number,
  from: number,
  to: number,
  onProgress: (fraction: number) => void,
): Float32Array {
  const divisor = greatestCommonDivisor(from, to);
  // Every `up` outputs one lies on a sample, `down` samples further. The outputs around it are computed with it.
  const [up, down] = [to / divisor, from / divisor];
  const radius = Math.floor(up / 2);
  const half = (SOXR.halfLength * from) / to;
  const reach = Math.ceil(half + (radius * down) / up);
  const filters = Array.from({ length: radius + 1 }, (_, outputs) =>
    mirroredWeights((outputs * down) / up, half, from, to),
  );
  const repetitions = 4 * Math.ceil(Math.min(BLOCK, length) / (4 * up));
  const samples = new Float64Array(repetitions * down + 2 * reach);
  const out = new Float32Array(length + repetitions * up + 2 * radius);
  for (let first = 0; first < length + radius; first += repetitions * up) {
    onProgress(Math.min(1, first / length));
    copyWithZeros(signal, origin + (first * down) / up - reach, samples);
    for (let repetition = 0; repetition < repetitions; repetition += 4) {
      const output = radius + first + repetition * up;
      filters.forEach((weights, outputs) => {
        filterMirrored(weights, samples, reach + repetition * down, down, out, output, outputs, up);
      });
    }
  }
  return out.slice(radius, radius + length);
}

/**
 * Weights for two outputs, `distance` input samples before and after a sample. One's weights are the other's in reverse,
 * so the sum of the outputs needs the sums of samples at equal distances alone, and their difference the differences.
 *
 * @param half half the length of the filter's window, in input samples
 * @returns the weights of the sums and of the differences in turn, from distance 0 to the ends of the windows
 */
function mirroredWeights(distance: number, half: number, from: number, to: number): Float64Array {
  return Float64Array.from({ length: 2 * Math.ceil(half + distance) }, (_, index) => {
    const away = index >> 1;
    const near = kernel(away - distance, from, to, SOXR);
    const far = kernel(away + distance, from, to, SOXR);
    if (index % 2 === 1) return (near - far) / 2;
    return away === 0 ? near / 2 : (near + far) / 2;
  });
}

/** Copies samples from index `start` on; those before and after the signal are zero. */
function copyWithZeros(signal: Float32Array, start: number, out: Float64Array): void {
  const begin = Math.max(0, -start);
  const end = Math.max(begin, Math.min(out.length, signal.length - start));
  out.fill(0);
  out.set(signal.subarray(start + begin, start + end), begin);
}

/** Weight of a sample `distance` input samples away from the output sample. */
function kernel(distance: number, from: number, to: number, { cutoff, beta, halfLength }: Filter): number {
  const time = (distance * to) / from;
  const inside = 1 - (time / halfLength) ** 2;
  if (inside <= 0) return 0;
  const angle = Math.PI * cutoff * time;
  const sinc = angle === 0 ? 1 : Math.sin(angle) / angle;
  return ((cutoff * to) / from) * sinc * (bessel(beta * Math.sqrt(inside)) / bessel(beta));
}

/** Modified Bessel function of the first kind, order 0, by its power series. */
function bessel(x: number): number {
  let [sum, term] = [1, 1];
  for (let k = 1; term > 1e-17 * sum; k++) {
    term *= (x / (2 * k)) ** 2;
    sum += term;
  }
  return sum;
}

/**
 * Computes two mirrored outputs in four places at once, which reads each weight once for all of them.
 *
 * @param centre index of the sample between the outputs; `step` samples further in each next place
 * @param output index of the output there, `distance` from the two; `stride` outputs further in each next place
 */
function filterMirrored(
  weights: Float64Array,
  samples: Float64Array,
  centre: number,
  step: number,
  out: Float32Array,
  output: number,
  distance: number,
  stride: number,
): void {
  const reach = weights.length >> 1;
  const centre2 = centre + step;
  const centre3 = centre2 + step;
  const centre4 = centre3 + step;
  let sum1 = 0;
  let difference1 = 0;
  let sum2 = 0;
  let difference2 = 0;
  let sum3 = 0;
  let difference3 = 0;
  let sum4 = 0;
  let difference4 = 0;
  for (let i = 0; i < reach; i++) {
    const even = weights[2 * i]!;
    const odd = weights[2 * i + 1]!;
    let after = samples[centre + i]!;
    let before = samples[centre - i]!;
    sum1 += even * (after + before);
    difference1 += odd * (after - before);
    after = samples[centre2 + i]!;
    before = samples[centre2 - i]!;
    sum2 += even * (after + before);
    difference2 += odd * (after - before);
    after = samples[centre3 + i]!;
    before = samples[centre3 - i]!;
    sum3 += even * (after + before);
    difference3 += odd * (after - before);
    after = samples[centre4 + i]!;
    before = samples[centre4 - i]!;
    sum4 += even * (after + before);
    difference4 += odd * (after - before);
  }
  const later = output + distance;
  const earlier = output - distance;
  out[later] = sum1 + difference1;
  out[earlier] = sum1 - difference1;
  out[later + stride] = sum2 + difference2;
  out[earlier + stride] = sum2 - difference2;
  out[later + 2 * stride] = sum3 + difference3;
  out[earlier + 2 * stride] = sum3 - difference3;
  out[later + 3 * stride] = sum4 + difference4;
  out[earlier + 3 * stride] = sum4 - difference4;
}

function greatestCommonDivisor(a: number, b: number): number {
  return b === 0 ? a : greatestCommonDivisor(b, a % b);
}
