import { windowMaximum } from '../math/statistics';
import { type MotionClip, shiftedLevel, type SolvedMotion } from '../skeleton/clip';
import { JOINT_COUNT } from '../skeleton/skeleton';

/** How fast a root may be beside a partner, the same as in training/evaluation/out_of_distribution.py. */
export interface GlideRule {
  /** By how much it may be faster than the partner's. */
  readonly ratio: number;
  /** Time to each side within which the partner's greatest speed counts, seconds. */
  readonly reach: number;
  /** Speed that every root may have, metres a second. */
  readonly free_speed: number;
}

/**
 * Slows a dancer down who would glide over the floor: a place that is told from the partner's heading swings far when
 * an unfamiliar partner turns fast. The root keeps to `ratio` times the partner's speed or `free_speed`, whichever is
 * more; a motion within that is returned as it is. Pure.
 *
 * The path is followed forwards and backwards, never faster than allowed, and the mean of both is taken: it begins to
 * move as early as it arrives late.
 *
 * @param motion the dancer who is slowed down
 * @param partner of the same frames and rate
 */
export function limitRootSpeed(motion: SolvedMotion, partner: MotionClip, rule: GlideRule): SolvedMotion {
  const limits = stepLimits(partner, rule);
  const path = levelPath(motion);
  const there = followed(path, limits);
  const back = followed(path.toReversed(), limits.toReversed()).toReversed();
  const along = (axis: 0 | 1): Float64Array =>
    Float64Array.from(path, (place, t) => (there[t]![axis] + back[t]![axis]) / 2 - place[axis]);
  const [x, z] = [along(0), along(1)];
  return x.some(Boolean) || z.some(Boolean) ? shiftedLevel(motion, x, z) : motion;
}

type Level = readonly [x: number, z: number];

/** Place of the root over the floor, metres. */
function levelPath({ positions, frames }: Pick<MotionClip, 'positions' | 'frames'>): Level[] {
  return Array.from({ length: frames }, (_, t) => {
    const root = t * JOINT_COUNT * 3;
    return [positions[root]!, positions[root + 2]!];
  });
}

/** How far a root may move from each frame to the next, metres; frames - 1 numbers. */
function stepLimits(partner: MotionClip, { ratio, reach, free_speed }: GlideRule): Float64Array {
  const path = levelPath(partner);
  const steps = Float64Array.from(path.slice(1), ([x, z], t) => Math.hypot(x - path[t]![0], z - path[t]![1]));
  const greatest = windowMaximum(steps, Math.round(reach * partner.fps));
  return greatest.map((step) => Math.max(free_speed / partner.fps, ratio * step));
}

/** A path that follows another one in steps that are not longer than the limits. */
function followed(path: readonly Level[], limits: Float64Array): Level[] {
  const out: Level[] = [path[0]!];
  for (let t = 1; t < path.length; t++) {
    const [x, z] = out[t - 1]!;
    const [dx, dz] = [path[t]![0] - x, path[t]![1] - z];
    const share = Math.min(1, limits[t - 1]! / Math.hypot(dx, dz) || 1);
    out.push(share === 1 ? path[t]! : [x + dx * share, z + dz * share]);
  }
  return out;
}
