import type { MotionClip } from '../skeleton/clip';
import { gaussianFilter } from '../math/statistics';

/** Mean joint speed between frames, metres per frame: frames - 1 values. */
function meanSpeed(positions: Float32Array, frames: number): Float64Array {
  const width = frames > 0 ? positions.length / frames : 0;
  const speed = new Float64Array(Math.max(0, frames - 1));
  for (let frame = 0; frame < speed.length; frame++) {
    let sum = 0;
    for (let at = frame * width; at < (frame + 1) * width; at += 3) {
      const x = positions[at + width]! - positions[at]!;
      const y = positions[at + width + 1]! - positions[at + 1]!;
      const z = positions[at + width + 2]! - positions[at + 2]!;
      sum += Math.sqrt(x * x + y * y + z * z);
    }
    speed[frame] = (3 * sum) / width;
  }
  return speed;
}

/**
 * Motion beats (as in Siyao et al., Bailando, 2022): frames at which the smoothed mean joint speed has a strict local
 * minimum. `motion_beats` of training/evaluation/metrics/beats.py.
 * @param clip any number of joints; fewer than two frames have no beat
 * @param smoothing standard deviation of the filter on the speed, frames; the manifest's
 * @returns frames in ascending order; frame f stands for the step from frame f to f + 1
 */
export function motionBeats(
  { positions, frames }: Pick<MotionClip, 'positions' | 'frames'>,
  smoothing: number,
): number[] {
  const speed = gaussianFilter(meanSpeed(positions, frames), smoothing);
  const beats: number[] = [];
  for (let frame = 1; frame + 1 < speed.length; frame++) {
    if (speed[frame]! < speed[frame - 1]! && speed[frame]! < speed[frame + 1]!) beats.push(frame);
  }
  return beats;
}
