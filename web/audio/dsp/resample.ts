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
  const centre = kernel(0, 2, 1, HALVING);
  const weights = Float64Array.from({ length: reach / 2 }, (_, i) => kernel(2 * i + 1, 2, 1, HALVING));
  const out = new Float32Array(Math.ceil(signal.length / 2) + 2 * margin);
  const samples = new Float64Array(2 * (BLOCK + reach));
  const block = new Float32Array(BLOCK);
  for (let first = 0; first < out.length; first += BLOCK) {
    copyWithZeros(signal, 2 * (first - margin) - reach, samples);
    for (let i = 0; i < BLOCK; i += 4) {
      const middle = 2 * i + reach;
      let a = centre * samples[middle]!;
      let b = centre * samples[middle + 2]!;
      let c = centre * samples[middle + 4]!;
      let d = centre * samples[middle + 6]!;
      for (let k = 0; k < weights.length; k++) {
        const weight = weights[k]!;
        const left = middle - 1 - 2 * k;
        const right = middle + 1 + 2 * k;
        a += weight * (samples[left]! + samples[right]!);
        b += weight * (samples[left + 2]! + samples[right + 2]!);
        c += weight * (samples[left + 4]! + samples[right + 4]!);
        d += weight * (samples[left + 6]! + samples[right + 6]!);
      }
      block[i] = a;
      block[i + 1] = b;
      block[i + 2] = c;
      block[i + 3] = d;
    }
    out.set(block.subarray(0, out.length - first), first);
  }
  return out;
}

/**
 * Filters and resamples by a rational factor, one precomputed filter for each position between two samples. Filters of
 * neighbouring outputs are in pairs, since they read the same samples.
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
  // Outputs repeat their positions between samples after `up` outputs, or `down` samples: an even number for the pairs.
  const even = (to / divisor) % 2 === 0 ? 1 : 2;
  const [up, down] = [(even * to) / divisor, (even * from) / divisor];
  const half = Math.ceil((SOXR.halfLength * from) / to);
  const taps = 2 * half + 1 + Math.ceil(down / up);
  const pairs = Array.from({ length: up / 2 }, (_, pair) =>
    Float64Array.from({ length: 2 * taps }, (_, index) => {
      const position = (((2 * pair * down) % up) + (index % 2) * down) / up;
      return kernel((index >> 1) - half - position, from, to, SOXR);
    }),
  );
  const repetitions = 4 * Math.ceil(Math.min(BLOCK, length) / (4 * up));
  const samples = new Float64Array(repetitions * down + taps);
  const block = new Float32Array(repetitions * up);
  const out = new Float32Array(length);
  for (let first = 0; first < length; first += block.length) {
    onProgress(first / length);
    copyWithZeros(signal, origin + (first * down) / up - half, samples);
    for (let repetition = 0; repetition < repetitions; repetition += 4) {
      pairs.forEach((weights, pair) => {
        const start = repetition * down + Math.floor((2 * pair * down) / up);
        filterPairs(weights, samples, start, down, block, repetition * up + 2 * pair, up);
      });
    }
    out.set(block.subarray(0, length - first), first);
  }
  return out;
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
 * Computes a pair of outputs in four places, which reads each weight and each sample once for several products.
 *
 * @param weights those of the first and of the second output, in turn
 * @param start index of the first sample under the weights; `step` samples further in each next place
 * @param first index of the first output; `stride` outputs further in each next place
 */
function filterPairs(
  weights: Float64Array,
  samples: Float64Array,
  start: number,
  step: number,
  out: Float32Array,
  first: number,
  stride: number,
): void {
  const taps = weights.length >> 1;
  const [second, third, fourth] = [start + step, start + 2 * step, start + 3 * step];
  let [a1, a2, a3, a4, b1, b2, b3, b4] = [0, 0, 0, 0, 0, 0, 0, 0];
  for (let i = 0; i < taps; i++) {
    const a = weights[2 * i]!;
    const b = weights[2 * i + 1]!;
    const s1 = samples[start + i]!;
    const s2 = samples[second + i]!;
    const s3 = samples[third + i]!;
    const s4 = samples[fourth + i]!;
    a1 += a * s1;
    b1 += b * s1;
    a2 += a * s2;
    b2 += b * s2;
    a3 += a * s3;
    b3 += b * s3;
    a4 += a * s4;
    b4 += b * s4;
  }
  out[first] = a1;
  out[first + 1] = b1;
  out[first + stride] = a2;
  out[first + stride + 1] = b2;
  out[first + 2 * stride] = a3;
  out[first + 2 * stride + 1] = b3;
  out[first + 3 * stride] = a4;
  out[first + 3 * stride + 1] = b4;
}

function greatestCommonDivisor(a: number, b: number): number {
  return b === 0 ? a : greatestCommonDivisor(b, a % b);
}
