import { JOINT_COUNT } from '../motion/skeleton/skeleton';
import { severity, type Measure, type Moment, type Scale, worstOf } from './moments';
import type { Duet, Rules } from './rules';

/** Jitter where the blocks of the model meet; NaN without a seam. */
export interface SeamJitter {
  readonly seams: number;
  /** |dv| at the seams over that of the rest of the motion: `against_interior` of training/evaluation/metrics/seams.py. */
  readonly ratio: number;
}

/**
 * |dv| in every frame: the mean over joints of ||p[t+1] - 2 p[t] + p[t-1]||, mm per frame^2, NaN at both ends.
 * `velocity_change` of training/evaluation/metrics/seams.py.
 */
export function velocityChange(positions: Float32Array, frames: number): Float64Array {
  const width = JOINT_COUNT * 3;
  return Float64Array.from({ length: frames }, (_, frame) => {
    if (frame === 0 || frame === frames - 1) return NaN;
    let sum = 0;
    for (let at = frame * width; at < (frame + 1) * width; at += 3) {
      const bend = (axis: number): number => {
        const here = positions[at + axis]!;
        return positions[at + axis + width]! - here - (here - positions[at + axis - width]!);
      };
      sum += Math.sqrt(bend(0) ** 2 + bend(1) ** 2 + bend(2) ** 2);
    }
    return (sum / JOINT_COUNT) * 1000;
  });
}

/**
 * Frames at which a new block begins: `boundaries` in Python. For a model whose blocks alternate in phase these are
 * the ones of the plain partition, as there.
 */
export function boundaries(frames: number, block: number): number[] {
  return Array.from(
    { length: Math.max(0, Math.ceil(frames / block) - 1) },
    (_, index) => (index + 1) * block,
  );
}

/** Mean of the values in frames whose distance to the nearest seam meets the condition; a seam lies between two frames. */
function meanWhere(
  values: Float64Array,
  seams: readonly number[],
  condition: (distance: number) => boolean,
): number {
  let sum = 0;
  let count = 0;
  values.forEach((value, frame) => {
    const distance = Math.min(...seams.map((seam) => Math.abs(frame - (seam - 0.5))));
    if (Number.isNaN(value) || !condition(distance)) return;
    sum += value;
    count++;
  });
  return sum / count;
}

/** Ratio of the jitter at a seam to that inside blocks from which it is a fault; 5 % of frames inside reach it too. */
const LIMIT = 2;
const SCALE: Scale = { fine: 0.5, limit: LIMIT, bad: 2 * LIMIT };

/** Jitter of the reactor at the seams of its blocks. */
export function measureSeams(duet: Duet, rules: Rules): Measure<SeamJitter> {
  const { radius, clear } = rules.seams;
  const change = velocityChange(duet.reactor, duet.frames);
  const seams = boundaries(duet.frames, duet.block);
  const inside = meanWhere(change, seams, (distance) => distance > clear);
  const jitterRatio = (some: readonly number[]): number =>
    meanWhere(change, some, (distance) => distance <= radius) / inside;
  const row = new Float32Array(duet.frames).fill(NaN);
  const moments = seams.map((seam): Moment => {
    const value = jitterRatio([seam]);
    const judged = severity(value, SCALE);
    row.fill(judged, Math.max(0, seam - clear), seam + clear);
    return { kind: 'seam', frame: seam, value, severity: judged };
  });
  return {
    whole: { seams: seams.length, ratio: jitterRatio(seams) },
    rows: [row],
    worst: worstOf(moments),
  };
}
