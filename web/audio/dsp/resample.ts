/**
 * The low-pass filter that soxr's 'HQ' quality puts under librosa's resampling, fitted to its impulse response to 6e-5
 * of the peak. Browsers resample with short filters of their own, which bend the highest mel bands by a third of a
 * standard deviation; that is why songs are decoded at a high rate and brought down here.
 */
const SOXR = {
  /** Edge of the pass band at half amplitude, relative to half the lower rate. */
  cutoff: 0.9568586,
  /** Shape of the Kaiser window. */
  beta: 14.6532,
  /** Half the length of the window, in samples at the lower rate. */
  reach: 105.279,
};

/** The filter of the halvings: its stop band begins where aliases of the kept frequencies would come from. */
const HALVING = { cutoff: 1, beta: 12.27, reach: 12 };

type Filter = typeof SOXR;

/**
 * Resamples to a lower rate like `librosa.resample` does (linear phase, no delay).
 *
 * @param from Hz, whole
 * @param to Hz, whole, at most `from`
 * @param onProgress hears ascending fractions of the work done
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
  // Far above the wanted rate a short filter is enough to halve it: half the work for the long one. The zeros at both
  // ends, a whole number of samples at either rate, keep what the short filter spreads over the ends.
  const divisor = greatestCommonDivisor(from, to);
  const blocks = Math.ceil((2 * HALVING.reach * divisor) / from);
  const lead = (blocks * from) / divisor;
  const padded = new Float32Array(audio.length + 2 * lead);
  padded.set(audio, lead);
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
  const half = Math.ceil((filter.reach * from) / to);
  const taps = 2 * half + 1;
  const phases = Array.from({ length: up }, (_, phase) =>
    Float64Array.from({ length: taps }, (_, tap) => kernel(tap - half - phase / up, from, to, filter)),
  );
  const padded = new Float64Array(signal.length + taps + 1);
  padded.set(signal, half);
  const out = new Float32Array(length);
  // Where an output lies beyond the signal it is zero.
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
function kernel(distance: number, from: number, to: number, { cutoff, beta, reach }: Filter): number {
  const time = (distance * to) / from;
  const inside = 1 - (time / reach) ** 2;
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

/** Outputs `first`, `first + up` ..., four in all: they share their weights, which halves what is read. */
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
