import { smoothstep } from '../../motion/math/vec3';
import { FPS, type MotionClip } from '../../motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../motion/skeleton/skeleton';

/** Heading of a camera that sees both dancers at a moment, radians about y; half a turn more sees them as well. */
export type HeadingPlan = (seconds: number) => number;

/** Seconds between two headings of the plan, and seconds between the frames that are looked at. */
const STEP = 8 / FPS;
const SAMPLE = 4 / FPS;
/** Headings in half a turn. */
const BINS = 60;
const BIN = Math.PI / BINS;
const SINES = Float64Array.from({ length: BINS }, (_, bin) => Math.sin(bin * BIN));
const COSINES = Float64Array.from({ length: BINS }, (_, bin) => Math.cos(bin * BIN));
/** Greatest turn in a step: 34 degrees a second. */
const MAX_BINS = 3;
/** Cost of a squared radian a second, where a dancer who hides the other for a second costs 1. */
const TURN_COST = 0.3;
/** Costs of turning by -`MAX_BINS` to `MAX_BINS` headings in a step. */
const TURN_COSTS = Float64Array.from(
  { length: 2 * MAX_BINS + 1 },
  (_, i) => TURN_COST * (((i - MAX_BINS) * BIN) / STEP) ** 2,
);
/** Distances of the same joints of both across the picture at which one hides the other, and none does, metres. */
const HIDDEN = 0.12;
const SEEN = 0.42;
const COMPARED = [J.pelvis, J.spine3, J.head];
/** Standard deviation of the smoothing of the plan, seconds. */
const SMOOTHING = 0.5;

/**
 * Plans how a camera turns with a couple so that neither dancer hides the other: the cheapest path of headings over
 * the whole dance by dynamic programming (Viterbi 1967), smoothed. It knows what comes, so that it turns slowly where
 * dancers change places fast.
 */
export function planHeading(leader: MotionClip, reactor: MotionClip): HeadingPlan {
  const frames = Math.min(leader.frames, reactor.frames);
  const steps = Math.max(1, Math.ceil(frames / leader.fps / STEP));
  const costs = hiddenCosts(leader, reactor, frames, steps);
  const plan = smoothed(cheapestPath(costs, steps));
  return (seconds) => {
    const at = Math.min(Math.max(0, seconds / STEP - 0.5), steps - 1);
    const before = Math.floor(at);
    const from = plan[before]!;
    return from + (plan[Math.min(before + 1, steps - 1)]! - from) * (at - before);
  };
}

/** How much of the couple is hidden in every step (rows) from every heading (columns), 0 to 1. */
function hiddenCosts(
  { positions: leader, fps }: MotionClip,
  { positions: reactor }: MotionClip,
  frames: number,
  steps: number,
): Float64Array {
  const costs = new Float64Array(steps * BINS);
  const counts = new Uint16Array(steps);
  const stride = Math.max(1, Math.round(SAMPLE * fps));
  for (let frame = 0; frame < frames; frame += stride) {
    const step = Math.min(steps - 1, Math.floor(frame / fps / STEP));
    counts[step]!++;
    for (const joint of COMPARED) {
      const at = (frame * JOINT_COUNT + joint) * 3;
      const x = leader[at]! - reactor[at]!;
      const z = leader[at + 2]! - reactor[at + 2]!;
      for (let bin = 0; bin < BINS; bin++) {
        const apart = Math.abs(x * COSINES[bin]! - z * SINES[bin]!);
        if (apart < SEEN) costs[step * BINS + bin]! += 1 - smoothstep(HIDDEN, SEEN, apart);
      }
    }
  }
  for (let step = 0; step < steps; step++) {
    const compared = COMPARED.length * Math.max(1, counts[step]!);
    for (let bin = 0; bin < BINS; bin++) costs[step * BINS + bin]! /= compared;
  }
  return costs;
}

/** The path of headings with the least sum of costs and turning, radians, without jumps by half turns. */
function cheapestPath(costs: Float64Array, steps: number): Float64Array {
  const cameFrom = new Int8Array(steps * BINS);
  let totals = costs.slice(0, BINS);
  // The totals of the step before, with as many of the other end at each end as a turn may reach.
  const around = new Float64Array(BINS + 2 * MAX_BINS);
  for (let step = 1; step < steps; step++) {
    around.set(totals, MAX_BINS);
    around.set(totals.subarray(BINS - MAX_BINS));
    around.set(totals.subarray(0, MAX_BINS), BINS + MAX_BINS);
    totals = costs.slice(step * BINS, (step + 1) * BINS);
    for (let bin = 0; bin < BINS; bin++) {
      let best = Infinity;
      let from = 0;
      for (let turn = 0; turn < TURN_COSTS.length; turn++) {
        const total = around[bin + turn]! + TURN_COSTS[turn]!;
        if (total >= best) continue;
        best = total;
        from = turn;
      }
      totals[bin]! += best;
      cameFrom[step * BINS + bin] = from - MAX_BINS;
    }
  }
  let bin = totals.indexOf(Math.min(...totals));
  const path = new Float64Array(steps);
  let heading = bin * BIN;
  for (let step = steps - 1; step >= 0; step--) {
    path[step] = heading;
    const turn = cameFrom[step * BINS + bin]!;
    heading += turn * BIN;
    bin = (bin + turn + BINS) % BINS;
  }
  return path;
}

/** The path convolved with a Gaussian. */
function smoothed(path: Float64Array): Float64Array {
  const reach = Math.ceil((3 * SMOOTHING) / STEP);
  return path.map((_, step) => {
    let [sum, weights] = [0, 0];
    for (let by = -reach; by <= reach; by++) {
      const weight = Math.exp(-(((by * STEP) / SMOOTHING) ** 2) / 2);
      sum += weight * path[Math.min(path.length - 1, Math.max(0, step + by))]!;
      weights += weight;
    }
    return sum / weights;
  });
}

/** The planned heading or half a turn more, whichever is within a quarter turn of `near`. */
export const nearestSide = (planned: number, near: number): number =>
  planned + Math.PI * Math.round((near - planned) / Math.PI);
