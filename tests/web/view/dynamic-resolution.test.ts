import { describe, expect, it } from 'vitest';
import { createSharpness, type Sharpness } from '../../../web/view/dynamic-resolution';

/** Pictures in a row that all come after `ms`; the factor after each. */
const pictures = (sharpness: Sharpness, count: number, ms: number): number[] =>
  Array.from({ length: count }, () => {
    sharpness.waited(ms);
    return sharpness.factor;
  });

describe('sharpness', () => {
  it('is whole where pictures come in time, and a slow one now and then is none of its business', () => {
    const sharpness = createSharpness();
    expect(new Set(pictures(sharpness, 300, 34))).toEqual(new Set([1]));
    for (let round = 0; round < 50; round++) {
      pictures(sharpness, 1, 400);
      expect(pictures(sharpness, 2, 17)).toEqual([1, 1]);
    }
  });

  it('goes down step by step while pictures are slow, to half the pixels along a side', () => {
    const sharpness = createSharpness();
    const factors = pictures(sharpness, 40, 120);
    expect([factors[3], factors[4], factors[8], factors[9], factors[39]]).toEqual([
      1,
      Math.SQRT1_2,
      Math.SQRT1_2,
      0.5,
      0.5,
    ]);
    // Neither slow nor so quick that there were time for more.
    expect(new Set(pictures(sharpness, 500, 30))).toEqual(new Set([0.5]));
  });

  it('comes back when there is time for more pixels, and tries less often what was too slow', () => {
    const sharpness = createSharpness();
    pictures(sharpness, 5, 120);
    const back = pictures(sharpness, 60, 17);
    expect([back[58], back[59]]).toEqual([Math.SQRT1_2, 1]);
    pictures(sharpness, 5, 120);
    expect(new Set(pictures(sharpness, 239, 17))).toEqual(new Set([Math.SQRT1_2]));
    expect(pictures(sharpness, 1, 17)).toEqual([1]);
  });
});
