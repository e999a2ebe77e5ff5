import { expect, it } from 'vitest';
import type { Person } from '../../../../web/video/pose/detector';
import { sameAsLast } from '../../../../web/video/pose/tracker';

const at = (x: number): Person => ({
  score: 1,
  box: [x - 10, 0, x + 10, 20],
  region: { x, y: 200, size: 200, angle: 0 },
});
const last = { region: { x: 100, y: 200, size: 200, angle: 0 }, time: 3 };

it('finds a lost person near where they were, and not whoever else is in the picture', () => {
  const [dancer, bystander] = [at(160), at(600)];
  expect(sameAsLast([bystander, dancer], last, 3.1)).toBe(dancer);
  expect(sameAsLast([bystander], last, 3.1)).toBeUndefined();
  // After three seconds they may have come from there.
  expect(sameAsLast([bystander], last, 6)).toBe(bystander);
  expect(sameAsLast([], last, 6)).toBeUndefined();
});
