import { describe, expect, it } from 'vitest';
import { speedCurve } from '../../../../../web/ui/timeline/lanes/curves';

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
