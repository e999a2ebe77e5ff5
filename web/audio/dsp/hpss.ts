import { medianOfRow, mirror, replaceSorted } from './median';
import type { AudioRecipe } from '../recipe';
import type { Progress, Spectrogram } from './stft';

/** Smallest normal float32: below it librosa counts a bin as empty and halves it. */
const TINY = 2 ** -126;

/** Receives the magnitudes of one frame; both arrays are reused for the next one. */
export type SeparatedFrame = (frame: number, harmonic: Float32Array, percussive: Float32Array) => void;

/**
 * Separates harmony, which lasts in time, from percussion, which spreads over frequency: medians along either axis and
 * soft masks (Fitzgerald 2010; `librosa.decompose.hpss`). Frames are handed out one by one, in order, so that the two
 * parts of a long song never exist at once.
 */
export function separate(
  spectrogram: Spectrogram,
  recipe: AudioRecipe,
  visit: SeparatedFrame,
  progress?: Progress,
): void {
  const { frames, bins, values } = spectrogram;
  const kernel = recipe.hpss_kernel;
  const half = (kernel - 1) / 2;
  const windows = firstWindows(spectrogram, kernel);
  const across = new Float32Array(bins);
  const harmonic = new Float32Array(bins);
  const percussive = new Float32Array(bins);
  for (let frame = 0; frame < frames; frame++) {
    if (frame > 0) {
      const leaving = mirror(frame - 1 - half, frames) * bins;
      const entering = mirror(frame + half, frames) * bins;
      for (let bin = 0; bin < bins; bin++) {
        replaceSorted(windows, bin * kernel, kernel, values[leaving + bin]!, values[entering + bin]!);
      }
    }
    medianOfRow(values, frame * bins, bins, kernel, across);
    for (let bin = 0; bin < bins; bin++) {
      const magnitude = values[frame * bins + bin]!;
      const share = harmonicShare(windows[bin * kernel + half]!, across[bin]!, recipe.hpss_power);
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
    for (let k = 0; k < kernel; k++) window[k] = values[mirror(k - half, frames) * bins + bin]!;
    window.sort();
  }
  return windows;
}

/** h^power / (h^power + p^power), a half where both are empty. */
function harmonicShare(harmonic: number, percussive: number, power: number): number {
  if (Math.max(harmonic, percussive) < TINY) return 0.5;
  // The ratio of the smaller to the larger can't overflow.
  return harmonic >= percussive
    ? 1 / (1 + (percussive / harmonic) ** power)
    : 1 - 1 / (1 + (harmonic / percussive) ** power);
}
