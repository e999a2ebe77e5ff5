import { expect, it } from 'vitest';
import { keyBefore } from '../../../../web/motion/math/key-before';

it('is the last key at or before a time, and never the last of all', () => {
  const times = [0, 1, 1, 4, 9, 10];
  const found = [0, 0.5, 1, 3.9, 4, 9.5, 10].map((time) => keyBefore(times, time));
  expect(found).toEqual([0, 0, 2, 2, 3, 4, 4]);
  expect(keyBefore([2, 3], 2.5)).toBe(0);
});
