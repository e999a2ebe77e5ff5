import { expect, it } from 'vitest';
import { solvePentadiagonal } from '../../../../web/motion/math/pentadiagonal';
import { noise } from '../../support/skeletons';

it.each([1, 2, 3, 40])('a system of %i rows is solved', (rows) => {
  const draw = noise(7);
  const column = (offset: number): Float64Array => Float64Array.from({ length: rows }, () => offset + draw());
  // Positive definite, because the diagonal outweighs the rest.
  const [diagonal, next, second, solution] = [column(9), column(0), column(0), column(0)];
  const product = solution.map((value, t) => {
    let sum = diagonal[t]! * value;
    if (t + 1 < rows) sum += next[t]! * solution[t + 1]!;
    if (t + 2 < rows) sum += second[t]! * solution[t + 2]!;
    if (t > 0) sum += next[t - 1]! * solution[t - 1]!;
    if (t > 1) sum += second[t - 2]! * solution[t - 2]!;
    return sum;
  });
  const found = solvePentadiagonal(diagonal, next, second, product);
  found.forEach((value, t) => expect(value).toBeCloseTo(solution[t]!, 10));
});
