import { type BodyRule, capsuleBody, candidatePairs, penetrationDepth, shiftedDepths } from './capsules';
import { type MotionClip, shiftedLevel, type SolvedMotion } from '../skeleton/clip';
import { type LevelShift, SHIFT_COLUMNS, SHIFTS, viterbiPath } from './viterbi-path';
import { gaussianFilter, type Run, runsOf } from '../math/statistics';
import type { JointName } from '../skeleton/skeleton';

/** Joints that end the bones of the arms. Partners hold each other, so arms may overlap. */
const ARMS: ReadonlySet<JointName> = new Set(['left_elbow', 'left_wrist', 'right_elbow', 'right_wrist']);
/** Time between two samples of the shift, and how long before and after an overlap it may differ from zero, seconds. */
const SAMPLE_INTERVAL = 0.1;
const MARGIN = 1.5;
/** Cost of a squared penetration depth, where a squared shift costs 1. */
const PENETRATION_COST = 20_000;
/** Standard deviation of the Gaussian filter over the shift, in seconds and in samples. */
const SMOOTHING = 0.2;
const SMOOTHING_SAMPLES = Math.round(SMOOTHING / SAMPLE_INTERVAL);

/** Runs of samples no farther than `margin` samples from an overlap, `to` excluded. */
function runsAround(overlaps: readonly boolean[], margin: number): Run[] {
  return runsOf(overlaps, 2 * margin + 1).map(({ from, to }) => ({
    from: Math.max(0, from - margin),
    to: Math.min(overlaps.length, to + margin),
  }));
}

/**
 * Cost of every one of `SHIFTS` at a sample. The deepest penetration within one standard deviation of the filter
 * counts, since the path is smoothed afterwards.
 */
function costsOf(depths: readonly Float64Array[], sample: number): Float64Array {
  const window = depths.slice(Math.max(0, sample - SMOOTHING_SAMPLES), sample + SMOOTHING_SAMPLES + 1);
  const deepest = new Float64Array(SHIFTS.length);
  for (const row of window) {
    for (let shift = 0; shift < row.length; shift++) deepest[shift] = Math.max(deepest[shift]!, row[shift]!);
  }
  for (let shift = 0; shift < deepest.length; shift++) {
    const { x, z } = SHIFTS[shift]!;
    const depth = deepest[shift]!;
    deepest[shift] = PENETRATION_COST * depth * depth + x * x + z * z;
  }
  return deepest;
}

/**
 * Samples `step` frames apart, interpolated linearly to every frame and smoothed.
 * @param deviation of the Gaussian filter, frames
 */
function everyFrame(
  samples: readonly number[],
  step: number,
  frames: number,
  deviation: number,
): Float64Array {
  const linear = Float64Array.from({ length: frames }, (_, frame) => {
    const sample = Math.floor(frame / step);
    const value = samples[sample]!;
    return value + ((samples[sample + 1] ?? value) - value) * (frame / step - sample);
  });
  return gaussianFilter(linear, deviation);
}

/** Frames between two samples of the shift. */
export function sampleStep(fps: number): number {
  return Math.max(1, Math.round(SAMPLE_INTERVAL * fps));
}

/**
 * Collision avoidance between two dancers: where trunks, heads or legs would overlap, the whole dancer is shifted level
 * with the floor by at most 0.56 m, along the cheapest smooth path (viterbi-path.ts). Arms may overlap. Rotations,
 * heights and bone lengths stay. More than 1.5 s away from an overlap nothing changes but for the filter, and a motion
 * without overlap is returned as it is. Pure.
 *
 * @param motion the dancer who is shifted
 * @param other the dancer who stays, of the same frames and rate
 * @param rule capsules of the bodies, and the depth from which an overlap counts
 */
export function avoidCollisions(motion: SolvedMotion, other: MotionClip, rule: BodyRule): SolvedMotion {
  const { frames, fps } = motion;
  const withoutArms = {
    ...rule,
    capsules: rule.capsules.filter(({ from, to }) => !ARMS.has(from) && !ARMS.has(to)),
  };
  const step = sampleStep(fps);
  const [a, b] = [capsuleBody(other, withoutArms, step), capsuleBody(motion, withoutArms, step)];
  const overlaps = Array.from(
    { length: Math.ceil(frames / step) },
    (_, sample) => penetrationDepth(a, b, candidatePairs(a, b, sample)) > rule.deep,
  );
  if (!overlaps.includes(true)) return motion;
  const path: LevelShift[] = overlaps.map(() => ({ x: 0, z: 0 }));
  for (const { from, to } of runsAround(overlaps, Math.round(MARGIN / SAMPLE_INTERVAL))) {
    const depths = Array.from({ length: to - from }, (_, i) => shiftedDepths(a, b, from + i, SHIFT_COLUMNS));
    const costs = depths.map((_, sample) => costsOf(depths, sample));
    path.splice(from, to - from, ...viterbiPath(costs, { start: from > 0, end: to < overlaps.length }));
  }
  const along = (axis: 'x' | 'z'): Float64Array =>
    everyFrame(
      path.map((shift) => shift[axis]),
      step,
      frames,
      SMOOTHING * fps,
    );
  const [x, z] = [along('x'), along('z')];
  return shiftedLevel(motion, x, z);
}
