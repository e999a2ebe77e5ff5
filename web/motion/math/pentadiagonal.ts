/**
 * Solves a symmetric positive definite system with five diagonals by an L D L^T factorisation, in linear time and in
 * place: all four arrays are overwritten.
 * @param diagonal one coefficient a row
 * @param next coefficients between row t and t + 1; the last one is not read
 * @param second coefficients between row t and t + 2; the last two are not read
 * @param right the right-hand side, which becomes the solution
 * @returns `right`
 */
export function solvePentadiagonal(
  diagonal: Float64Array,
  next: Float64Array,
  second: Float64Array,
  right: Float64Array,
): Float64Array {
  const rows = diagonal.length;
  for (let t = 0; t < rows; t++) {
    const pivot = diagonal[t]!;
    const one = next[t]! / pivot;
    const two = second[t]! / pivot;
    if (t + 1 < rows) {
      diagonal[t + 1]! -= one * one * pivot;
      next[t + 1]! -= one * two * pivot;
      right[t + 1]! -= one * right[t]!;
    }
    if (t + 2 < rows) {
      diagonal[t + 2]! -= two * two * pivot;
      right[t + 2]! -= two * right[t]!;
    }
    next[t] = one;
    second[t] = two;
    right[t]! /= pivot;
  }
  for (let t = rows - 2; t >= 0; t--)
    right[t]! -= next[t]! * right[t + 1]! + (t + 2 < rows ? second[t]! * right[t + 2]! : 0);
  return right;
}

/**
 * Solves the normal equations of a column with weight x (value before - 2 x value + value after)^2 of every row added to
 * them, which makes the solution even. In place, with arguments and result as in `solvePentadiagonal`.
 */
export function solveEven(
  diagonal: Float64Array,
  right: Float64Array,
  weight: number,
  next = new Float64Array(diagonal.length),
): Float64Array {
  const second = new Float64Array(diagonal.length);
  for (let t = 1; t < diagonal.length - 1; t++) {
    diagonal[t - 1]! += weight;
    diagonal[t]! += 4 * weight;
    diagonal[t + 1]! += weight;
    next[t - 1]! -= 2 * weight;
    next[t]! -= 2 * weight;
    second[t - 1]! += weight;
  }
  return solvePentadiagonal(diagonal, next, second, right);
}
