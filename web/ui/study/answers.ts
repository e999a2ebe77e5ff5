/** What is asked about a pair of dances, and the answers. */
import type { Pair } from './plan';

/** The criteria of the paper's user study, in its order, as they are asked. */
export const CRITERIA = [
  { id: 'naturalness', question: 'Which partner moves more naturally?' },
  { id: 'music', question: 'Which partner fits the music better?' },
  { id: 'interaction', question: 'Which partner dances together with the leader better?' },
] as const;

export type Criterion = (typeof CRITERIA)[number]['id'];

/** Five steps from the left dance to the right one. */
export const CHOICES = [
  { score: -2, text: 'A clearly' },
  { score: -1, text: 'A a little' },
  { score: 0, text: 'no difference' },
  { score: 1, text: 'B a little' },
  { score: 2, text: 'B clearly' },
] as const;

/** An answer to one question about one pair. */
export interface Answer extends Pair {
  readonly participant: string;
  /** Name of the set of dances. */
  readonly set: string;
  /** Of the participant's plan. */
  readonly seed: number;
  /** Counted from 1. */
  readonly pair: number;
  readonly criterion: Criterion;
  /** -2 to 2; below 0 the left dance is preferred. */
  readonly score: number;
  /** Seconds from the first showing of the pair to this answer; after a reload from the first one since then. */
  readonly seconds: number;
}

/** The questions about a dance; that about the music is left out where there is none. */
export function criteriaFor(hasMusic: boolean): readonly (typeof CRITERIA)[number][] {
  return CRITERIA.filter(({ id }) => hasMusic || id !== 'music');
}

/** The method that an answer prefers; null for no difference. */
export function preferred({ score, left, right }: Answer): string | null {
  return score === 0 ? null : score < 0 ? left : right;
}

/** The answers without those that are there again, the same in all, as when a file is chosen twice. */
export function withoutRepeats(answers: readonly Answer[]): Answer[] {
  return [...new Map(answers.map((answer) => [JSON.stringify(answer), answer])).values()];
}
