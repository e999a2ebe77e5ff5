import type { ShiftColumn } from './capsules';

/** Spacing of the grid of shifts, metres. */
const GRID_STEP = 0.14;
/** Longest shift, metres. */
const MAX_SHIFT = 0.56;
/** Largest change of the shift from one sample to the next, metres. */
const MAX_CHANGE = 0.2;
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
export const SHIFTS: readonly LevelShift[] = AXIS.flatMap((x) => AXIS.map((z) => ({ x, z }))).filter(
  ({ x, z }) => Math.hypot(x, z) <= MAX_SHIFT + EPSILON,
);
export const SHIFT_COLUMNS: readonly ShiftColumn[] = AXIS.map((x) => ({
  first: SHIFTS.findIndex((shift) => shift.x === x),
  x,
  z: Float64Array.from(SHIFTS.filter((shift) => shift.x === x).map(({ z }) => z)),
}));

const ZERO_SHIFT = SHIFTS.findIndex(({ x, z }) => x === 0 && z === 0);

/** Steps of the path: the state that each comes from, and its cost. */
interface Steps {
  readonly from: Int16Array;
  readonly costs: Float64Array;
}

/** The steps into each state that are short enough, with the cost of the change alone. */
const TRANSITIONS: readonly Steps[] = SHIFTS.map(({ x, z }) => {
  const changes = SHIFTS.map((from) => Math.hypot(from.x - x, from.z - z));
  const from = Int16Array.from(changes.keys()).filter((state) => changes[state]! <= MAX_CHANGE + EPSILON);
  return { from, costs: Float64Array.from(from, (state) => CHANGE_COST * changes[state]! * changes[state]!) };
});

/** The cheapest way into each state: the state before it, and the total of the costs. */
function advance(totals: Float64Array, own: Float64Array): Steps {
  const cheapest = { from: new Int16Array(totals.length), costs: new Float64Array(totals.length) };
  for (let state = 0; state < totals.length; state++) {
    const { from, costs } = TRANSITIONS[state]!;
    let least = Infinity;
    let best = 0;
    for (let i = 0; i < from.length; i++) {
      const total = totals[from[i]!]! + costs[i]!;
      if (total >= least) continue;
      least = total;
      best = from[i]!;
    }
    cheapest.from[state] = best;
    cheapest.costs[state] = least + own[state]!;
  }
  return cheapest;
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
  let totals: Float64Array = costs[0]!.map((cost, state) =>
    zeroAt.start && state !== ZERO_SHIFT ? Infinity : cost,
  );
  const backpointers = costs.slice(1).map((own) => {
    const steps = advance(totals, own);
    totals = steps.costs;
    return steps.from;
  });
  let state = zeroAt.end ? ZERO_SHIFT : totals.indexOf(Math.min(...totals));
  const path = [state];
  for (const previous of backpointers.reverse()) path.push((state = previous[state]!));
  return path.reverse().map((at) => SHIFTS[at]!);
}
