import { describe, expect, it } from 'vitest';
import { createDynamicResolution, type DynamicResolution } from '../../../web/view/dynamic-resolution';

/** Frames in a row that all wait `ms` milliseconds; the share of the pixels after each. */
const frames = (resolution: DynamicResolution, count: number, ms: number): number[] =>
  Array.from({ length: count }, () => {
    resolution.frameWaited(ms);
    return resolution.share;
  });

describe('dynamic resolution', () => {
  it('is full where frames come in time, and ignores a slow one now and then', () => {
    const resolution = createDynamicResolution();
    expect(new Set(frames(resolution, 300, 34))).toEqual(new Set([1]));
    for (let round = 0; round < 50; round++) {
      frames(resolution, 1, 400);
      expect(frames(resolution, 2, 17)).toEqual([1, 1]);
    }
  });

  it('goes down step by step while frames are slow, to half the pixels along a side', () => {
    const resolution = createDynamicResolution();
    const shares = frames(resolution, 40, 120);
    expect([shares[3], shares[4], shares[8], shares[9], shares[39]]).toEqual([
      1,
      Math.SQRT1_2,
      Math.SQRT1_2,
      0.5,
      0.5,
    ]);
    // Neither slow nor so quick that there were time for more.
    expect(new Set(frames(resolution, 500, 30))).toEqual(new Set([0.5]));
  });

  it('rises when there is time for more pixels, and tries less often what was too slow', () => {
    const resolution = createDynamicResolution();
    frames(resolution, 5, 120);
    const back = frames(resolution, 60, 17);
    expect([back[58], back[59]]).toEqual([Math.SQRT1_2, 1]);
    frames(resolution, 5, 120);
    expect(new Set(frames(resolution, 239, 17))).toEqual(new Set([Math.SQRT1_2]));
    expect(frames(resolution, 1, 17)).toEqual([1]);
  });
});
