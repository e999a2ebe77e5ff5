import { describe, expect, it } from 'vitest';
import type { Observations } from '../../../../web/video/observations';
import { adviceOnCuts, longestShot } from '../../../../web/video/world/shots';

/** Ten pictures a second for ten seconds; the dancer is seen from `from` on. */
function seen(cuts: readonly number[], from = 0): Observations {
  const times = Float64Array.from({ length: 100 }, (_, row) => row / 10);
  return { times, presence: Float32Array.from(times, (time) => Number(time >= from)), cuts } as Observations;
}

describe('the part of a video that is used', () => {
  it('is all of it where there is no cut', () => {
    expect(longestShot(seen([]))).toBeNull();
  });

  it('is the longest one between two cuts, without the pictures beside it', () => {
    expect(longestShot(seen([3, 8]))).toEqual({ start: 3, end: 7.9 });
    expect(longestShot(seen([6]))).toEqual({ start: 0, end: 5.9 });
    expect(longestShot(seen([4]))).toEqual({ start: 4, end: 9.9 });
  });

  it('is where the dancer is seen longest', () => {
    expect(longestShot(seen([6], 4))).toEqual({ start: 6, end: 9.9 });
  });
});

describe('the sentence about cuts', () => {
  it('says which part is used', () => {
    expect(adviceOnCuts([], null)).toEqual([]);
    expect(adviceOnCuts([3], { start: 3, end: 9.9 })).toEqual([
      'The video has a cut at 3.0 s. The longest part without a cut is used, from 3.0 to 9.9 s; choose another under “Correct the motion”.',
    ]);
    expect(adviceOnCuts([3, 8], { start: 3, end: 7.9 })[0]).toContain('has cuts at 3.0, 8.0 s.');
    expect(adviceOnCuts([1, 2, 3, 4], { start: 4, end: 9.9 })[0]).toContain(
      'has 4 cuts, the first at 1.0 s.',
    );
  });

  it('warns of a part that was chosen across one', () => {
    expect(adviceOnCuts([3, 8], { start: 0, end: 5 })).toEqual([
      'There is a cut at 3.0 s in what is used: what is before and after a cut does not fit together. Choose a part without cuts under “Correct the motion”.',
    ]);
  });
});
