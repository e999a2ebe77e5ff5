import { describe, expect, it } from 'vitest';
import { peaks, speedCurve } from '../../../../../web/ui/timeline/lanes/curves';

describe('waveform', () => {
  it('keeps the lowest and highest sample of each column', () => {
    const pcm = Float32Array.of(0.1, 0.5, -0.2, 0, -0.9, 0.3, 0, 0);
    const { low, high } = peaks(pcm, 8, { from: 0, to: 1 }, 4);
    expect([...high].map((value) => Number(value.toFixed(2)))).toEqual([0.5, 0, 0.3, 0]);
    expect([...low].map((value) => Number(value.toFixed(2)))).toEqual([0, -0.2, -0.9, 0]);
  });

  it('is flat after the end of the song and ends with the dance', () => {
    const pcm = new Float32Array(100).fill(0.5);
    expect([...peaks(pcm, 100, { from: 0, to: 2 }, 4).high]).toEqual([0.5, 0.5, 0, 0]);
    expect([...peaks(pcm, 100, { from: 0, to: 0.5 }, 2).high]).toEqual([0.5, 0.5]);
  });
});

describe('a part of a waveform', () => {
  it('is flat before the song begins', () => {
    const pcm = new Float32Array(100).fill(0.5);
    expect([...peaks(pcm, 100, { from: -0.5, to: 0.5 }, 4).high]).toEqual([0, 0, 0.5, 0.5]);
  });
});

describe('speed of a dancer', () => {
  const moving = (frames: number, metresPerFrame: number): Float32Array => {
    const positions = new Float32Array(frames * 66);
    for (let frame = 0; frame < frames; frame++)
      for (let joint = 0; joint < 22; joint++) positions[(frame * 22 + joint) * 3] = frame * metresPerFrame;
    return positions;
  };

  it('is in metres per second and level for a level walk', () => {
    const curve = speedCurve({ positions: moving(60, 0.05), frames: 60, fps: 30 });
    expect(curve).toHaveLength(60);
    for (const speed of curve) expect(speed).toBeCloseTo(1.5, 4);
  });

  it('shows where the dancer stands still', () => {
    const positions = moving(90, 0.05);
    positions.set(
      new Float32Array(30 * 66).map((_, index) => positions[59 * 66 + (index % 66)] ?? 0),
      60 * 66,
    );
    const curve = speedCurve({ positions, frames: 90, fps: 30 });
    expect(curve[30]).toBeCloseTo(1.5, 4);
    expect(curve[80]).toBeCloseTo(0, 4);
  });

  it('takes a clip of one frame and of none', () => {
    expect([...speedCurve({ positions: moving(1, 1), frames: 1, fps: 30 })]).toEqual([0]);
    expect(speedCurve({ positions: moving(0, 1), frames: 0, fps: 30 })).toHaveLength(0);
  });
});
