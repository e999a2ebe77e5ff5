import { describe, expect, test } from 'vitest';
import { bodyHeight } from '../../../../web/motion/skeleton/scale';
import { J, MIRROR, PARENTS, SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { median, percentile } from '../../../../web/motion/math/statistics';
import { BODY, madeDancer, random, scaled } from '../../support/made-dancer';

const bone = (joint: number): number => Math.hypot(...BODY[joint]!);
const HEIGHT =
  bone(J.left_knee) +
  bone(J.left_ankle) +
  bone(J.spine1) +
  bone(J.spine2) +
  bone(J.spine3) +
  bone(J.neck) +
  bone(J.head);

describe('body height', () => {
  test('is leg plus spine, in any pose', () => {
    expect(bodyHeight(madeDancer({ frames: 40, seed: 1 }))).toBeCloseTo(HEIGHT, 5);
    expect(bodyHeight(madeDancer({ frames: 40, seed: 2, spin: 1 }))).toBeCloseTo(HEIGHT, 5);
  });
  test('is proportional to the scale of the clip', () => {
    expect(bodyHeight(scaled(madeDancer({ frames: 40 }), 1.2))).toBeCloseTo(1.2 * HEIGHT, 5);
  });
  test('is robust to a few broken frames', () => {
    const clip = madeDancer({ frames: 40 });
    clip.positions.fill(9, 0, 5 * 66);
    expect(bodyHeight(clip)).toBeCloseTo(HEIGHT, 5);
  });
});

describe('percentiles', () => {
  test('interpolate between ranks', () => {
    expect(percentile([4, 1, 3, 2], 50)).toBe(2.5);
    expect(percentile([10, 20], 10)).toBe(11);
    expect(percentile([5], 90)).toBe(5);
    expect(median([3, 1, 2])).toBe(2);
    expect(median([])).toBeNaN();
  });

  test('are those of the sorted list, with equal values in it', () => {
    const draw = random(3);
    for (let count = 1; count < 60; count++) {
      const values = Array.from({ length: count }, () => Math.floor(20 * draw()));
      const sorted = values.slice().sort((a, b) => a - b);
      for (const share of [0, 10, 25, 50, 95, 100]) {
        const rank = ((count - 1) * share) / 100;
        const [low, high] = [sorted[Math.floor(rank)]!, sorted[Math.ceil(rank)]!];
        expect(percentile(values, share)).toBeCloseTo(low + (high - low) * (rank % 1), 9);
      }
    }
  });
});

describe('the skeleton', () => {
  test('lists parents before children, and its mirror map is its own inverse', () => {
    expect(SMPL22).toHaveLength(22);
    PARENTS.forEach((parent, joint) => expect(parent).toBeLessThan(joint));
    MIRROR.forEach((other, joint) => {
      expect(MIRROR[other]).toBe(joint);
      expect(PARENTS[other]).toBe(joint === 0 ? -1 : MIRROR[PARENTS[joint]!]);
    });
  });
});
