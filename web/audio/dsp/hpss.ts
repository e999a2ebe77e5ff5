import { medianOfRow, medianWindows, reflectedIndex, replaceRow } from './median';
import type { AudioRecipe } from '../recipe';
import type { Progress, Spectrogram } from './stft';

/** Smallest normal float32. librosa treats smaller magnitudes as 0 and gives half of them to each part. */
const MIN_NORMAL_FLOAT32 = 2 ** -126;

/** Receives the powers (squared magnitudes) of one frame; both arrays are reused for the next one. */
type SeparatedFrame = (frame: number, harmonic: Float64Array, percussive: Float64Array) => void;

/**
 * Harmonic-percussive source separation: median filters along time (harmonic) and along frequency (percussive), and
 * soft masks (Fitzgerald 2010; `librosa.decompose.hpss`). `visit` is called frame by frame, in order, so that the two
 * parts of a long song are never in memory as a whole.
 */
export function separateHarmonicPercussive(
  spectrogram: Spectrogram,
  recipe: AudioRecipe,
  visit: SeparatedFrame,
  progress: Progress,
): void {
  const { frames, bins, values } = spectrogram;
  const kernel = recipe.hpss_kernel;
  const half = (kernel - 1) / 2;
  const bits = new Int32Array(values.buffer, values.byteOffset, values.length);
  const acrossTime = medianWindows(bins, kernel);
  const acrossFrequency = medianWindows(1, kernel);
  const harmonicMedian = new Float32Array(bins);
  const harmonicBits = new Int32Array(harmonicMedian.buffer);
  const percussiveMedian = new Float32Array(bins);
  const percussiveBits = new Int32Array(percussiveMedian.buffer);
  const harmonic = new Float64Array(bins);
  const percussive = new Float64Array(bins);
  // The frame that enters the windows is half a window ahead; the first frame needs all windows filled.
  for (let entering = -half; entering < frames + half; entering++) {
    const row = reflectedIndex(entering, frames) * bins;
    const slot = (entering + half) % kernel;
    replaceRow(acrossTime, slot, bits, row, harmonicBits);
    const frame = entering - half;
    if (frame < 0) continue;
    medianOfRow(bits, frame * bins, bins, acrossFrequency, percussiveBits);
    const magnitudes = values.subarray(frame * bins, (frame + 1) * bins);
    maskFrame(magnitudes, harmonicMedian, percussiveMedian, recipe.hpss_power, harmonic, percussive);
    visit(frame, harmonic, percussive);
    progress(frame + 1, frames);
  }
}

/** Divides the power of one frame among its harmonic and its percussive part. */
function maskFrame(
  magnitudes: Float32Array,
  harmonicMedian: Float32Array,
  percussiveMedian: Float32Array,
  exponent: number,
  harmonic: Float64Array,
  percussive: Float64Array,
): void {
  for (let bin = 0; bin < magnitudes.length; bin++) {
    const magnitude = magnitudes[bin]!;
    const share = harmonicShare(harmonicMedian[bin]!, percussiveMedian[bin]!, exponent);
    harmonic[bin] = (magnitude * share) ** 2;
    percussive[bin] = (magnitude * (1 - share)) ** 2;
  }
}

/** h^power / (h^power + p^power), 0.5 where both are 0. */
function harmonicShare(harmonic: number, percussive: number, power: number): number {
  if (harmonic < MIN_NORMAL_FLOAT32 && percussive < MIN_NORMAL_FLOAT32) return 0.5;
  // The usual power: doubles hold the squares of all float32 values.
  if (power === 2) return harmonic ** 2 / (harmonic ** 2 + percussive ** 2);
  // The ratio of the smaller to the larger can't overflow.
  return harmonic >= percussive
    ? 1 / (1 + (percussive / harmonic) ** power)
    : 1 - 1 / (1 + (harmonic / percussive) ** power);
}
