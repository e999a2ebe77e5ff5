import { describe, expect, it } from 'vitest';
import {
  danceDistance,
  mostDifferent,
  mostDifferentFrame,
  poseDistance,
} from '../../../../web/motion/skeleton/difference';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { madeDancer } from '../../support/made-dancer';

const { positions } = madeDancer({ frames: 20 });

/** The dance with its right wrist moved up in each frame, metres. */
function raised(by: (frame: number) => number): Float32Array {
  const out = positions.slice();
  for (let frame = 0; frame < 20; frame++) out[(frame * JOINT_COUNT + J.right_wrist) * 3 + 1]! += by(frame);
  return out;
}

describe('the distance of two dances', () => {
  it('is the mean over joints and frames, and nothing where only the place differs', () => {
    const elsewhere = positions.map((value, i) => value + ((i % 3) + 1) * 0.7);
    expect(danceDistance(positions, elsewhere)).toBeLessThan(1e-6);
    const wave = raised((frame) => (frame < 5 ? 0.44 : 0));
    expect(poseDistance(positions, wave, 3)).toBeCloseTo(0.02, 6);
    expect(poseDistance(positions, wave, 7)).toBe(0);
    expect(danceDistance(positions, wave)).toBeCloseTo(0.005, 6);
  });
});

describe('the dances that differ most', () => {
  const heights = [0, 0.1, 0.25, 0.3, 0.6, 0.65];
  const dances = heights.map((height) => raised(() => height));

  it('are those of which the two nearest are as far apart as possible', () => {
    expect(mostDifferent(dances, 3)).toEqual([0, 3, 4]);
    expect(mostDifferent(dances, 2)).toEqual([0, 5]);
    expect(mostDifferent(dances.slice(0, 3), 3)).toEqual([0, 1, 2]);
  });

  it('are the earliest ones among equals', () => {
    expect(mostDifferent([dances[0]!, dances[4]!, dances[0]!, dances[4]!], 2)).toEqual([0, 1]);
  });

  it('are seen in the frame in which the two nearest are as far apart as possible', () => {
    // In frame 8 one of them is far from the other two, which are alike there.
    const high = raised((frame) => (frame === 8 ? 2 : frame === 12 ? 0.4 : 0.1));
    const low = raised((frame) => (frame === 12 ? -0.4 : 0));
    expect(mostDifferentFrame([positions, high, low])).toBe(12);
    expect(mostDifferentFrame([positions, high])).toBe(8);
  });
});
