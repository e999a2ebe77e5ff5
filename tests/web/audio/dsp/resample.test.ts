import { describe, expect, it } from 'vitest';
import { resample } from '../../../../web/audio/dsp/resample';
import { fixture, readFloats, readWav, recipe } from '../../support/audio/audio-fixtures';

function tone(hz: number, rate: number): Float32Array {
  return Float32Array.from({ length: rate }, (_, i) => Math.sin((2 * Math.PI * hz * i) / rate));
}

/** Largest sample away from the ends. */
function peak(signal: Float32Array): number {
  return signal.subarray(2000, -2000).reduce((largest, sample) => Math.max(largest, Math.abs(sample)), 0);
}

describe('resampling to the recipe rate', () => {
  it.each([48000, 44100])('resamples noise of %i Hz as librosa does', (rate) => {
    const ours = resample(readWav(fixture(`noise-${rate}.wav`)), rate, recipe.sample_rate);
    const reference = readFloats(fixture(`noise-${rate}.f32`));
    expect(ours.length).toBe(reference.length);
    // Not the very first sample: soxr loses a hundredth of it.
    const worst = ours
      .slice(1)
      .reduce((most, sample, i) => Math.max(most, Math.abs(sample - reference[i + 1]!)), 0);
    expect(worst).toBeLessThan(3e-4);
  });

  it('keeps the frequencies below half the lower rate and removes the others', () => {
    expect(peak(resample(tone(440, 48000), 48000, 15360))).toBeCloseTo(1, 3);
    expect(peak(resample(tone(6900, 48000), 48000, 15360))).toBeCloseTo(1, 2);
    expect(peak(resample(tone(7800, 48000), 48000, 15360))).toBeLessThan(1e-4);
    expect(peak(resample(tone(23000, 48000), 48000, 15360))).toBeLessThan(1e-4);
  });

  it('does not delay', () => {
    const impulse = new Float32Array(4800);
    impulse[2400] = 1;
    const out = resample(impulse, 48000, 15360);
    expect(out.indexOf(Math.max(...out))).toBe((2400 * 15360) / 48000);
  });

  it.each([1, 2, 3, 4, 1000])('returns the ceiling of the length for %i samples', (length) => {
    expect(resample(new Float32Array(length).fill(0.5), 48000, 15360).length).toBe(Math.ceil(length * 0.32));
  });

  it('returns a signal that has the rate already', () => {
    const signal = tone(440, 15360);
    expect(resample(signal, 15360, 15360)).toBe(signal);
  });
});
