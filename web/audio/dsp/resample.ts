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

/** The filter that halves the rate: it removes the frequencies that would alias into those that are kept. */
const HALVING: Filter = { cutoff: 1, beta: 12.27, halfLength: 12 };

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
  if (from < 3 * to || from % 2 === 1) return convert(audio, length, from, to, SOXR, onProgress);
  // From a much higher rate, a short filter halves the rate first, which leaves half the work for the long filter. The
  // zeros at both ends, a whole number of samples at either rate, hold what the short filter spreads over the ends.
  const divisor = greatestCommonDivisor(from, to);
  const blocks = Math.ceil((2 * HALVING.halfLength * divisor) / from);
  const padding = (blocks * from) / divisor;
  const padded = new Float32Array(audio.length + 2 * padding);
  padded.set(audio, padding);
  const halved = convert(padded, Math.ceil(padded.length / 2), from, from / 2, HALVING);
  const start = (blocks * to) / divisor;
  return convert(halved, start + length, from / 2, to, SOXR, onProgress).slice(start);
}

/** Filters and resamples by a rational factor, one precomputed filter for each position between two samples. */
function convert(
  signal: Float32Array,
  length: number,
  from: number,
  to: number,
  filter: Filter,
  onProgress: (fraction: number) => void = () => undefined,
): Float32Array {
  const divisor = greatestCommonDivisor(from, to);
  const [up, down] = [to / divisor, from / divisor];
  const half = Math.ceil((filter.halfLength * from) / to);
  const taps = 2 * half + 1;
  const phases = Array.from({ length: up }, (_, phase) =>
    Float64Array.from({ length: taps }, (_, tap) => kernel(tap - half - phase / up, from, to, filter)),
  );
  const padded = new Float64Array(signal.length + taps + 1);
  padded.set(signal, half);
  const out = new Float32Array(length);
  // Outputs beyond the end of the signal are zero.
  const inside = Math.min(length, Math.ceil((signal.length * up) / down));
  for (let first = 0; first < up; first++) {
    onProgress(first / up);
    const weights = phases[(first * down) % up]!;
    let i = first;
    for (; i + 3 * up < inside; i += 4 * up) dot4(weights, padded, i, up, down, out);
    for (; i < inside; i += up) out[i] = dot(weights, padded, Math.floor((i * down) / up));
  }
  return out;
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

/** Scalar product of all weights with as many values from index `start` on. */
function dot(weights: Float64Array, values: Float64Array, start: number): number {
  let sum = 0;
  for (let i = 0; i < weights.length; i++) sum += weights[i]! * values[start + i]!;
  return sum;
}

/** Computes four outputs, `first`, `first + up` and so on, with the same weights, which halves what is read. */
function dot4(
  weights: Float64Array,
  values: Float64Array,
  first: number,
  up: number,
  down: number,
  out: Float32Array,
): void {
  const start = Math.floor((first * down) / up);
  const taps = weights.length;
  const [second, third, fourth] = [start + down, start + 2 * down, start + 3 * down];
  let [a, b, c, d] = [0, 0, 0, 0];
  for (let i = 0; i < taps; i++) {
    const weight = weights[i]!;
    a += weight * values[start + i]!;
    b += weight * values[second + i]!;
    c += weight * values[third + i]!;
    d += weight * values[fourth + i]!;
  }
  out[first] = a;
  out[first + up] = b;
  out[first + 2 * up] = c;
  out[first + 3 * up] = d;
}

function greatestCommonDivisor(a: number, b: number): number {
  return b === 0 ? a : greatestCommonDivisor(b, a % b);
}
