import { LANDMARK_COUNT } from '../pose/landmarks';
import { BODY, OTHER_SIDE } from '../pose/landmark-names';
import type { Series } from './series';

/**
 * How a frame's landmarks may be wrong: left and right exchanged, front and back exchanged (depth mirrored), or both,
 * which is how a network errs that takes a back for a front.
 */
const STATES = [
  { exchanged: false, mirrored: false },
  { exchanged: true, mirrored: false },
  { exchanged: false, mirrored: true },
  { exchanged: true, mirrored: true },
] as const;
/** Cost of a frame that is changed, square metres: what is seen is right most of the time. */
const CHANGE_COST = 0.0015;
/** Cost of a picture's step, relative to the same step in space: exchanged sides are seen there too. */
const IMAGE_WEIGHT = 1;

/**
 * Finds flips and undoes them: of all ways to change frames the one in which the body moves least from frame to frame
 * (Viterbi 1967), with a cost for each changed frame.
 * @returns the series, and how many frames were changed
 */
export function undoFlips(series: Series): { readonly series: Series; readonly changed: number } {
  const states = cheapestStates(series);
  const changed = states.reduce((count, one) => count + Number(one > 0), 0);
  return { series: changed === 0 ? series : applied(series, states), changed };
}

/** The state of each frame, as places in `STATES`, for which steps and changes cost least together. */
function cheapestStates(series: Series): Uint8Array {
  const { frames } = series;
  const metresPerPixel = imageScale(series);
  const costs = Float64Array.from(STATES, (_, state) => changeCost(state));
  /** For each frame and state: the state before it on the cheapest way there. */
  const from = new Uint8Array(frames * STATES.length);
  for (let frame = 1; frame < frames; frame++) {
    const before = costs.slice();
    for (let to = 0; to < STATES.length; to++) {
      let best = Infinity;
      for (let state = 0; state < STATES.length; state++) {
        const cost = before[state]! + stepCost(series, frame, STATES[state]!, STATES[to]!, metresPerPixel);
        if (cost >= best) continue;
        best = cost;
        from[frame * STATES.length + to] = state;
      }
      costs[to] = best + changeCost(to);
    }
  }
  const states = new Uint8Array(frames);
  let state = costs.indexOf(Math.min(...costs));
  for (let frame = frames - 1; frame >= 0; frame--) {
    states[frame] = state;
    state = from[frame * STATES.length + state]!;
  }
  return states;
}

function changeCost(state: number): number {
  return state === 0 ? 0 : CHANGE_COST;
}

type State = (typeof STATES)[number];

/** Mean squared movement of the body from the frame before, square metres. */
function stepCost(
  { world, image }: Series,
  frame: number,
  before: State,
  now: State,
  metresPerPixel: number,
): number {
  const [last, row] = [(frame - 1) * LANDMARK_COUNT, frame * LANDMARK_COUNT];
  const depthSign = before.mirrored === now.mirrored ? 1 : -1;
  let sum = 0;
  for (const landmark of BODY) {
    const a = last + (before.exchanged ? OTHER_SIDE[landmark]! : landmark);
    const b = row + (now.exchanged ? OTHER_SIDE[landmark]! : landmark);
    const x = world[3 * a]! - world[3 * b]!;
    const y = world[3 * a + 1]! - world[3 * b + 1]!;
    const z = world[3 * a + 2]! - depthSign * world[3 * b + 2]!;
    const u = (image[2 * a]! - image[2 * b]!) * metresPerPixel;
    const v = (image[2 * a + 1]! - image[2 * b + 1]!) * metresPerPixel;
    sum += x * x + y * y + z * z + IMAGE_WEIGHT * (u * u + v * v);
  }
  return sum / BODY.length;
}

/** Metres of the body to a pixel of the picture, over the whole series. */
function imageScale({ world, image, frames }: Series): number {
  let [metres, pixels] = [0, 0];
  for (let frame = 0; frame < frames; frame++) {
    const [a, b] = [frame * LANDMARK_COUNT + 11, frame * LANDMARK_COUNT + 28];
    metres += Math.hypot(world[3 * a]! - world[3 * b]!, world[3 * a + 1]! - world[3 * b + 1]!);
    pixels += Math.hypot(image[2 * a]! - image[2 * b]!, image[2 * a + 1]! - image[2 * b + 1]!);
  }
  return pixels > 0 ? metres / pixels : 0;
}

function applied(series: Series, states: Uint8Array): Series {
  const image = series.image.slice();
  const world = series.world.slice();
  const visibility = series.visibility.slice();
  states.forEach((index, frame) => {
    const { exchanged, mirrored } = STATES[index]!;
    const row = frame * LANDMARK_COUNT;
    for (let landmark = 0; landmark < LANDMARK_COUNT; landmark++) {
      const source = row + (exchanged ? OTHER_SIDE[landmark]! : landmark);
      const target = row + landmark;
      image.set(series.image.subarray(2 * source, 2 * source + 2), 2 * target);
      world.set(series.world.subarray(3 * source, 3 * source + 3), 3 * target);
      if (mirrored) world[3 * target + 2]! *= -1;
      visibility[target] = series.visibility[source]!;
    }
  });
  return { ...series, image, world, visibility };
}
