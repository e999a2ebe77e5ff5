import type { MotionClip } from '../skeleton/clip';
import { JOINT_COUNT } from '../skeleton/skeleton';
import { median } from '../math/statistics';
import { readVec, sub, type Vec3 } from '../math/vec3';

/** Speed over the floor of a joint that comes to stand, and of one that has left again, m/s. */
const ENTER = 0.5;
export const LEAVE = 0.9;
/** A standing joint rises or sinks slower than this, m/s. */
const VERTICAL = 0.2;
/**
 * A standing joint is at most this far above the height at which it usually rests, metres. Its lowest height would
 * say less: made feet dip below the floor while they swing, and hover where they stand.
 */
const HEIGHT = 0.04;
/** Shorter than this nobody stands, seconds. */
const SHORTEST = 0.13;

/** Frames between which a joint stands: from `first` on, up to and with `last`. */
export interface Stretch {
  readonly first: number;
  readonly last: number;
}

/**
 * The stretches of time in which a joint of the foot is meant to stand, although it may slide.
 *
 * Two speeds tell them (hysteresis): a stretch is as long as the joint stays low and below the higher one, and it
 * counts when somewhere in it the joint nearly rests. One speed alone would cut a stretch in two wherever a slide is
 * a little faster.
 */
export function plantedStretches(clip: MotionClip, joint: number): Stretch[] {
  const { frames, fps } = clip;
  const at = (frame: number): Vec3 => readVec(clip.positions, frame * JOINT_COUNT + joint);
  /** Speed over the floor up to the next frame, or Infinity while the joint rises or sinks. */
  const speeds = Array.from({ length: frames - 1 }, (_, frame) => {
    const [x, y, z] = sub(at(frame + 1), at(frame));
    return Math.abs(y) * fps < VERTICAL ? Math.hypot(x, z) * fps : Infinity;
  });
  const resting = speeds.flatMap((speed, frame) => (speed < ENTER ? [at(frame)[1]] : []));
  const highest = median(resting) + HEIGHT;

  const stretches: Stretch[] = [];
  let first = 0;
  let slowest = Infinity;
  for (let frame = 0; frame < frames; frame++) {
    const low = frame + 1 < frames && Math.max(at(frame)[1], at(frame + 1)[1]) < highest;
    const now = low ? speeds[frame]! : Infinity;
    if (now < LEAVE) {
      slowest = Math.min(slowest, now);
      continue;
    }
    if (slowest < ENTER && frame - first >= SHORTEST * fps) stretches.push({ first, last: frame });
    first = frame + 1;
    slowest = Infinity;
  }
  return stretches;
}
