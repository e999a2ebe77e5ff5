import { type Answer, CRITERIA, type Criterion } from './answers';

/** How one method did against another in one criterion. */
export interface Comparison {
  readonly method: string;
  readonly against: string;
  readonly criterion: Criterion;
  readonly answers: number;
  readonly wins: number;
  readonly equal: number;
  readonly losses: number;
  /** (wins + equal / 2) / answers. */
  readonly rate: number;
  /** 95 % interval of the rate. */
  readonly interval: readonly [low: number, high: number];
  /** Mean score in favour of the method, -2 to 2. */
  readonly mean: number;
}

/** Standard normal quantile of a 95 % interval. */
const Z = 1.959964;

/** Wilson's score interval for a share of n answers (Wilson 1927); [0, 1] for none. */
export function wilson(share: number, n: number): readonly [number, number] {
  if (n === 0) return [0, 1];
  const z2 = (Z * Z) / n;
  const middle = share + z2 / 2;
  const half = Z * Math.sqrt((share * (1 - share)) / n + z2 / (4 * n));
  // The ends of a share of 0 or 1 are exactly there.
  const low = share === 0 ? 0 : (middle - half) / (1 + z2);
  return [low, share === 1 ? 1 : (middle + half) / (1 + z2)];
}

/**
 * Every two methods that were compared, by criterion: the reference against the others, in alphabetical order; without
 * it, each against those after it.
 */
export function summarise(answers: readonly Answer[], reference: string | null): Comparison[] {
  const methods = [...new Set(answers.flatMap(({ left, right }) => [left, right]))].sort(
    (a, b) => Number(b === reference) - Number(a === reference) || (a < b ? -1 : 1),
  );
  return methods.flatMap((method, i) =>
    methods.slice(i + 1).flatMap((against) =>
      CRITERIA.flatMap(({ id }) => {
        const scores = answers
          .filter(({ criterion }) => criterion === id)
          .flatMap(({ left, right, score }) =>
            left === method && right === against
              ? [-score]
              : left === against && right === method
                ? [score]
                : [],
          );
        return scores.length > 0 ? [comparisonOf(method, against, id, scores)] : [];
      }),
    ),
  );
}

/** @param scores in favour of the method */
function comparisonOf(
  method: string,
  against: string,
  criterion: Criterion,
  scores: readonly number[],
): Comparison {
  const n = scores.length;
  const wins = scores.filter((score) => score > 0).length;
  const losses = scores.filter((score) => score < 0).length;
  const equal = n - wins - losses;
  const rate = (wins + equal / 2) / n;
  return {
    ...{ method, against, criterion, answers: n, wins, equal, losses, rate },
    interval: wilson(rate, n),
    mean: scores.reduce((sum, score) => sum + score, 0) / n,
  };
}
