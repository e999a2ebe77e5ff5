/** Which dances are shown beside which, in which order and on which side. */

/** A leader's dance with several partners, one of each method. */
export interface Comparable {
  readonly name: string;
  readonly methods: readonly string[];
}

/** Two partners of one leader. */
export interface Pair {
  readonly duet: string;
  readonly left: string;
  readonly right: string;
}

/** Pairs a person is asked about in the paper's user study. */
export const USUAL_PAIRS = 15;

/** Numbers in [0, 1) that follow from a seed (mulberry32). */
function randomFrom(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** In random order (Fisher and Yates). */
function shuffled<T>(list: readonly T[], random: () => number): T[] {
  const result = [...list];
  for (let i = result.length - 1; i > 0; i--) {
    const j = Math.floor(random() * (i + 1));
    [result[i], result[j]] = [result[j]!, result[i]!];
  }
  return result;
}

/**
 * The pairs of one participant. With a reference, as the paper has it, each other method is compared with that one; without
 * one, all methods with each other. Of more pairs than wanted, every two methods get as many as the others, and each
 * method is as often on the left as on the right.
 *
 * @param reference a method, "ours"; null for none
 * @param most pairs at most
 * @param seed the same seed gives the same plan
 */
export function makePlan(
  duets: readonly Comparable[],
  reference: string | null,
  most: number,
  seed: number,
): Pair[] {
  const random = randomFrom(seed);
  const byMethods = new Map<string, (readonly [duet: string, a: string, b: string])[]>();
  for (const { name, methods } of duets) {
    // In one order in all duets, whatever that of the files: sides are given in turn.
    const opponents = reference ? methods.filter((method) => method !== reference) : [...methods].sort();
    const two: (readonly [string, string])[] = reference
      ? methods.includes(reference)
        ? opponents.map((other) => [reference, other] as const)
        : []
      : opponents.flatMap((a, i) => opponents.slice(i + 1).map((b) => [a, b] as const));
    for (const [a, b] of two) {
      const key = JSON.stringify([a, b].sort());
      byMethods.set(key, [...(byMethods.get(key) ?? []), [name, a, b]]);
    }
  }
  const groups = shuffled([...byMethods.values()], random).map((group) => {
    // Half of them have the first one on the left; which half is drawn.
    const first = random() < 0.5 ? 0 : 1;
    return shuffled(group, random).map(([duet, a, b], i): Pair => {
      const [left, right] = i % 2 === first ? [a, b] : [b, a];
      return { duet, left, right };
    });
  });
  const rounds = Math.max(0, ...groups.map(({ length }) => length));
  const inTurn = Array.from({ length: rounds }, (_, round) =>
    groups.flatMap((group) => group[round] ?? []),
  ).flat();
  return shuffled(inTurn.slice(0, most), random);
}
