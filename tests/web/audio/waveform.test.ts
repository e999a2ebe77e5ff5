import { describe, expect, it } from 'vitest';
import { columnsOf, waveformOf } from '../../../web/audio/waveform';

const rounded = (values: Float32Array): number[] => [...values].map((value) => Number(value.toFixed(2)));

describe('the waveform of a song', () => {
  it('keeps the lowest and highest sample of each step, as shares of the loudest', () => {
    const pcm = Float32Array.of(0.1, 0.4, -0.2, 0, -0.8, 0.2, 0, 0);
    const waveform = waveformOf(pcm, 2000);
    expect(waveform.loudest).toBeCloseTo(0.8, 6);
    const { low, high } = columnsOf(waveform, { from: 0, to: 4e-3 }, 4);
    expect(rounded(high)).toEqual([0.5, 0, 0.25, 0]);
    expect(rounded(low)).toEqual([0, -0.25, -1, 0]);
  });

  it('covers every sample where the rate is no multiple of its own', () => {
    const pcm = new Float32Array(15360);
    pcm.forEach((_, i) => (pcm[i] = i === 0 || i === pcm.length - 1 ? 0.5 : 0));
    const { high } = waveformOf(pcm, 15360);
    expect(high).toHaveLength(1000);
    expect([high[0], high[1], high[998], high[999]]).toEqual([127, 0, 0, 127]);
  });

  it('has a step for what is left at its end', () => {
    const { high } = waveformOf(Float32Array.of(0.1, 0.1, 0.5), 2000);
    expect([...high]).toEqual([25, 127]);
  });

  it('is small: two thousand bytes a second', () => {
    const { low, high } = waveformOf(new Float32Array(15360), 15360);
    expect(low.byteLength + high.byteLength).toBe(2000);
  });

  it('of silence is flat', () => {
    const { low, high } = columnsOf(waveformOf(new Float32Array(2000), 2000), { from: 0, to: 1 }, 3);
    expect([...low, ...high]).toEqual([0, 0, 0, 0, 0, 0]);
  });
});

describe('what is drawn of it', () => {
  const half = waveformOf(new Float32Array(1000).fill(0.5), 1000);

  it('is flat before the song begins and after it ends', () => {
    expect(rounded(columnsOf(half, { from: -0.5, to: 0.5 }, 4).high)).toEqual([0, 0, 1, 1]);
    expect(rounded(columnsOf(half, { from: 0, to: 2 }, 4).high)).toEqual([1, 1, 0, 0]);
    expect(rounded(columnsOf(half, { from: 0, to: 0.5 }, 2).high)).toEqual([1, 1]);
  });

  it('has no gaps where columns are narrower than a step', () => {
    expect(rounded(columnsOf(half, { from: 0.1, to: 0.102 }, 8).high)).toEqual([1, 1, 1, 1, 1, 1, 1, 1]);
  });

  it('of a song that is nearly silent is low', () => {
    const quiet = waveformOf(new Float32Array(1000).fill(1e-4), 1000);
    expect(rounded(columnsOf(quiet, { from: 0, to: 1 }, 2).high)).toEqual([0.1, 0.1]);
  });
});
