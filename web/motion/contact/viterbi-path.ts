import type { ShiftColumn } from './capsules';

/** Spacing of the grid of shifts, metres. */
const GRID_STEP = 0.07;
/** Longest shift, metres. */
const MAX_SHIFT = 0.63;
/** Largest change of the shift from one sample to the next, metres. */
const MAX_CHANGE = 0.21;
/** Cost of a squared change of the shift, where a squared shift costs 1. */
const CHANGE_COST = 50;
/** Rounding slack of comparisons on the grid, metres. */
const EPSILON = 1e-9;

/** A shift level with the floor, metres. */
export interface LevelShift {
  readonly x: number;
  readonly z: number;
}

const CELLS = Math.floor(MAX_SHIFT / GRID_STEP + EPSILON);
const AXIS = Array.from({ length: 2 * CELLS + 1 }, (_, i) => (i - CELLS) * GRID_STEP);

/** The states of the path: all shifts on a square grid within a circle, zero among them. */
export const SHIFT_COLUMNS: readonly ShiftColumn[] = AXIS.map((x) => ({
  x,
  z: Float64Array.from(AXIS.filter((z) => Math.hypot(x, z) <= MAX_SHIFT + EPSILON)),
}));
export const SHIFTS: readonly LevelShift[] = SHIFT_COLUMNS.flatMap(({ x, z }) =>
  Array.from(z, (value) => ({ x, z: value })),
);

const ZERO_SHIFT = SHIFTS.findIndex(({ x, z }) => x === 0 && z === 0);

/** The states from which a state can follow, and the cost of each transition, the cheapest first. */
interface Transitions {
  readonly states: Int16Array;
  readonly costs: Float64Array;
}

const TRANSITIONS: readonly Transitions[] = SHIFTS.map(({ x, z }) => {
  const into = SHIFTS.flatMap((from, state) => {
    const change = Math.hypot(from.x - x, from.z - z);
    return change <= MAX_CHANGE + EPSILON ? [{ state, cost: CHANGE_COST * change * change }] : [];
  }).sort((a, b) => a.cost - b.cost);
  return {
    states: Int16Array.from(into, ({ state }) => state),
    costs: Float64Array.from(into, ({ cost }) => cost),
  };
});

/**
 * One sample of the path: least total cost of every state, and the state before it.
 *
 * @param before least total costs up to the sample before
 * @param costs of the states at this sample
 * @param totals is written
 * @param previous is written; of several states at the same cost it is the first
 */
function advance(
  before: Float64Array,
  costs: Float64Array,
  totals: Float64Array,
  previous: Int16Array,
): void {
  let lowest = Infinity;
  for (let state = 0; state < before.length; state++) lowest = Math.min(lowest, before[state]!);
  for (let state = 0; state < costs.length; state++) {
    const { states, costs: changes } = TRANSITIONS[state]!;
    let least = Infinity;
    let best = 0;
    // Transitions only become dearer: none can win any more that is too dear even from the state of the lowest total.
    for (let i = 0; i < states.length && lowest + changes[i]! <= least; i++) {
      const from = states[i]!;
      const total = before[from]! + changes[i]!;
      if (total < least || (total === least && from < best)) {
        least = total;
        best = from;
      }
    }
    totals[state] = least + costs[state]!;
    previous[state] = best;
  }
}

/**
 * The path of least total cost through the grid of shifts, by dynamic programming (Viterbi, Error bounds for
 * convolutional codes, 1967): the sum of the states' costs and of the costs of changing the shift.
 *
 * @param costs one array a sample, at least one, with the cost of every one of `SHIFTS`
 * @param zeroAt whether the path has to begin, and to end, with a shift of zero
 * @returns one shift a sample
 */
export function viterbiPath(
  costs: readonly Float64Array[],
  zeroAt: { readonly start: boolean; readonly end: boolean },
): LevelShift[] {
  const states = SHIFTS.length;
  let totals = costs[0]!.map((cost, state) => (zeroAt.start && state !== ZERO_SHIFT ? Infinity : cost));
  let next = new Float64Array(states);
  const previous = new Int16Array(costs.length * states);
  for (let sample = 1; sample < costs.length; sample++) {
    advance(totals, costs[sample]!, next, previous.subarray(sample * states, (sample + 1) * states));
    [totals, next] = [next, totals];
  }
  let state = zeroAt.end ? ZERO_SHIFT : totals.indexOf(Math.min(...totals));
  const path = [SHIFTS[state]!];
  for (let sample = costs.length - 1; sample > 0; sample--) {
    state = previous[sample * states + state]!;
    path.push(SHIFTS[state]!);
  }
  return path.reverse();
}
