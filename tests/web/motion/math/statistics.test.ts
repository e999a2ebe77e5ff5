import { expect, test } from 'vitest';
import { percentile } from '../../../../web/motion/math/statistics';
import { noise } from '../../support/skeletons';

test('percentiles are those of the values in order, whatever the order and however many are equal', () => {
  const next = noise(3);
  for (let count = 1; count < 60; count++) {
    const values = Array.from({ length: count }, () => Math.floor(next() * 12));
    const inOrder = values.toSorted((a, b) => a - b);
    for (const share of [0, 5, 50, 80, 100]) {
      const rank = ((count - 1) * share) / 100;
      const [low, high] = [inOrder[Math.floor(rank)]!, inOrder[Math.ceil(rank)]!];
      expect(percentile(values, share)).toBeCloseTo(low + (high - low) * (rank % 1), 9);
    }
  }
});
