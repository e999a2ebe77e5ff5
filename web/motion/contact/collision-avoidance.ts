import { type BodyRule, type CapsuleBody, capsuleBody, closePairs, deepest } from './capsules';
import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { cheapestDetour, FARTHEST, type Place, PLACES } from './viterbi-path';
import { smoothed } from '../math/gaussian';
import { JOINT_COUNT, type JointName } from '../skeleton/skeleton';

/** Arms hold and wind round the other in a dance; these joints end the bones that may. */
const ARMS: ReadonlySet<JointName> = new Set(['left_elbow', 'left_wrist', 'right_elbow', 'right_wrist']);
/** Places are looked for this often, and this long before and after bodies meet, seconds. */
const EVERY = 0.1;
const AROUND = 1.5;
/** What overlap costs against standing aside, both in metres squared. */
const OVERLAP = 20_000;
/** Standard deviation of the filter that rounds the way, seconds; so many samples are that. */
const ROUND = 0.2;
const FELT = Math.round(ROUND / EVERY);

/** Runs of samples no farther than `reach` from one that is true, `to` excluded. */
function runsAround(hits: readonly boolean[], reach: number): { from: number; to: number }[] {
  const runs: { from: number; to: number }[] = [];
  hits.forEach((hit, at) => {
    if (!hit) return;
    const [from, to] = [Math.max(0, at - reach), Math.min(hits.length, at + reach + 1)];
    const last = runs.at(-1);
    if (last && from <= last.to) last.to = to;
    else runs.push({ from, to });
  });
  return runs;
}

/** How deep the second dancer would be in the first, at every one of `PLACES`, metres. */
function depthsAt(a: CapsuleBody, b: CapsuleBody, frame: number): Float64Array {
  const pairs = closePairs(a, b, frame, FARTHEST);
  return Float64Array.from(PLACES, ({ x, z }) => deepest(a, b, pairs, x, z));
}

/** What the places cost at a sample. Overlap is felt a little early and late, since the way is rounded afterwards. */
function costsAt(depths: readonly Float64Array[], sample: number): Float64Array {
  const around = depths.slice(Math.max(0, sample - FELT), sample + FELT + 1);
  return Float64Array.from(PLACES, ({ x, z }, place) => {
    const depth = Math.max(...around.map((row) => row[place]!));
    return OVERLAP * depth * depth + x * x + z * z;
  });
}

/** Values of samples `step` frames apart, at every frame and rounded off. */
function everyFrame(
  samples: readonly number[],
  step: number,
  frames: number,
  deviation: number,
): Float64Array {
  const between = Float64Array.from({ length: frames }, (_, frame) => {
    const at = Math.floor(frame / step);
    const here = samples[at]!;
    return here + ((samples[at + 1] ?? here) - here) * (frame / step - at);
  });
  return smoothed(between, deviation);
}

/**
 * The motion kept out of the other dancer's body: where trunks, heads or legs would be in each other, the whole dancer
 * stands a little aside for that while, on the cheapest smooth way over the floor (viterbi-path.ts), at most 0.63 m.
 * Arms may hold. Turns, heights and bone lengths stay; away from such moments everything does, and a motion without
 * them is returned as it is. Pure.
 *
 * @param other the dancer who stays, of the same frames and rate
 */
export function keepApart(motion: SolvedMotion, other: MotionClip, rule: BodyRule): SolvedMotion {
  const { frames, fps } = motion;
  const solid = {
    ...rule,
    capsules: rule.capsules.filter(({ from, to }) => !ARMS.has(from) && !ARMS.has(to)),
  };
  const [a, b] = [capsuleBody(other, solid), capsuleBody(motion, solid)];
  const step = Math.max(1, Math.round(EVERY * fps));
  const hits = Array.from(
    { length: Math.ceil(frames / step) },
    (_, sample) => deepest(a, b, closePairs(a, b, sample * step)) > rule.deep,
  );
  if (!hits.includes(true)) return motion;
  const way: Place[] = hits.map(() => ({ x: 0, z: 0 }));
  for (const { from, to } of runsAround(hits, Math.round(AROUND / EVERY))) {
    const depths = Array.from({ length: to - from }, (_, i) => depthsAt(a, b, (from + i) * step));
    const costs = depths.map((_, sample) => costsAt(depths, sample));
    way.splice(from, to - from, ...cheapestDetour(costs, { start: from > 0, end: to < hits.length }));
  }
  const along = (axis: 'x' | 'z'): Float64Array =>
    everyFrame(
      way.map((place) => place[axis]),
      step,
      frames,
      ROUND * fps,
    );
  const [x, z] = [along('x'), along('z')];
  const shifted = (values: Float32Array, joints: number): Float32Array =>
    values.map((value, i) => {
      const frame = Math.floor(i / (3 * joints));
      return i % 3 === 0 ? value + x[frame]! : i % 3 === 2 ? value + z[frame]! : value;
    });
  return { ...motion, root: shifted(motion.root, 1), positions: shifted(motion.positions, JOINT_COUNT) };
}
