/** Distance between two places to step aside to, and of the farthest, metres. */
const CELL = 0.07;
const FARTHEST = 0.63;
/** Longest step from one sample to the next, metres. */
const STRIDE = 0.21;
/** How much a step costs against standing as far aside, both squared. */
const HASTE = 50;

/** A place to stand instead: level shift in metres. */
export interface Place {
  readonly x: number;
  readonly z: number;
}

const REACH = Math.floor(FARTHEST / CELL + 1e-9);
const LINE = Array.from({ length: 2 * REACH + 1 }, (_, i) => (i - REACH) * CELL);

/** All places on a square grid within a circle; the middle, where nobody steps aside, is one of them. */
export const PLACES: readonly Place[] = LINE.flatMap((x) => LINE.map((z) => ({ x, z }))).filter(
  ({ x, z }) => Math.hypot(x, z) <= FARTHEST + 1e-9,
);
export { FARTHEST };

const HERE = PLACES.findIndex(({ x, z }) => x === 0 && z === 0);

/** From where each place can be reached in one step, and what the step costs. */
const STEPS = PLACES.map(({ x, z }) =>
  PLACES.flatMap((from, place) => {
    const far = Math.hypot(from.x - x, from.z - z);
    return far <= STRIDE + 1e-9 ? [{ place, cost: HASTE * far * far }] : [];
  }),
);

/**
 * The cheapest way through places that cost something: dynamic programming over all ways (Viterbi), so that a way
 * round is found early where a late one would be long.
 *
 * @param costs one array a sample, at least one, with the cost of every one of `PLACES`
 * @param pinned whether the way begins, and ends, where nobody stepped aside
 * @returns a place for every sample
 */
export function cheapestDetour(
  costs: readonly Float64Array[],
  pinned: { readonly start: boolean; readonly end: boolean },
): Place[] {
  let sums = costs[0]!.map((cost, place) => (pinned.start && place !== HERE ? Infinity : cost));
  const before = costs.slice(1).map((cost) => {
    const from = new Int16Array(PLACES.length);
    sums = cost.map((here, place) => {
      let least = Infinity;
      for (const step of STEPS[place]!) {
        const sum = sums[step.place]! + step.cost;
        if (sum < least) [least, from[place]] = [sum, step.place];
      }
      return least + here;
    });
    return from;
  });
  let place = pinned.end ? HERE : sums.indexOf(Math.min(...sums));
  const way = [place];
  for (const from of before.reverse()) way.push((place = from[place]!));
  return way.reverse().map((at) => PLACES[at]!);
}
