import { medianOfRow, reflectedIndex, replaceSorted } from './median';
import type { AudioRecipe } from '../recipe';
import type { Progress, Spectrogram } from './stft';

/** Smallest normal float32. librosa treats smaller magnitudes as 0 and gives half of them to each part. */
const MIN_NORMAL_FLOAT32 = 2 ** -126;

/** Receives the magnitudes of one frame; both arrays are reused for the next one. */
type SeparatedFrame = (frame: number, harmonic: Float32Array, percussive: Float32Array) => void;

/**
 * Harmonic-percussive source separation: median filters along time (harmonic) and along frequency (percussive), and
 * soft masks (Fitzgerald 2010; `librosa.decompose.hpss`). `visit` is called frame by frame, in order, so that the two
 * parts of a long song are never in memory as a whole.
 */
export function separateHarmonicPercussive(
  spectrogram: Spectrogram,
  recipe: AudioRecipe,
  visit: SeparatedFrame,
  progress?: Progress,
): void {
  const { frames, bins, values } = spectrogram;
  const kernel = recipe.hpss_kernel;
  const half = (kernel - 1) / 2;
  const windows = firstWindows(spectrogram, kernel);
  const percussiveMedian = new Float32Array(bins);
  const harmonic = new Float32Array(bins);
  const percussive = new Float32Array(bins);
  for (let frame = 0; frame < frames; frame++) {
    if (frame > 0) {
      const leaving = reflectedIndex(frame - 1 - half, frames) * bins;
      const entering = reflectedIndex(frame + half, frames) * bins;
      for (let bin = 0; bin < bins; bin++) {
        replaceSorted(windows, bin * kernel, kernel, values[leaving + bin]!, values[entering + bin]!);
      }
    }
    medianOfRow(values, frame * bins, bins, kernel, percussiveMedian);
    for (let bin = 0; bin < bins; bin++) {
      const magnitude = values[frame * bins + bin]!;
      const share = harmonicShare(windows[bin * kernel + half]!, percussiveMedian[bin]!, recipe.hpss_power);
      harmonic[bin] = magnitude * share;
      percussive[bin] = magnitude * (1 - share);
    }
    visit(frame, harmonic, percussive);
    progress?.(frame + 1, frames);
  }
}

/** bins x kernel: for each bin, the sorted values of the frames around frame 0. */
function firstWindows({ frames, bins, values }: Spectrogram, kernel: number): Float32Array {
  const windows = new Float32Array(bins * kernel);
  const half = (kernel - 1) / 2;
  for (let bin = 0; bin < bins; bin++) {
    const window = windows.subarray(bin * kernel, (bin + 1) * kernel);
    for (let k = 0; k < kernel; k++) window[k] = values[reflectedIndex(k - half, frames) * bins + bin]!;
    window.sort();
  }
  return windows;
}

/** h^power / (h^power + p^power), 0.5 where both are 0. */
function harmonicShare(harmonic: number, percussive: number, power: number): number {
  if (Math.max(harmonic, percussive) < MIN_NORMAL_FLOAT32) return 0.5;
  // The ratio of the smaller to the larger can't overflow.
  return harmonic >= percussive
    ? 1 / (1 + (percussive / harmonic) ** power)
    : 1 - 1 / (1 + (harmonic / percussive) ** power);
}
