import type { MotionClip } from './clip';

/** Mean joint speed between frames, metres per frame: frames - 1 values. */
function meanSpeed(positions: Float32Array, frames: number): Float64Array {
  const width = frames > 0 ? positions.length / frames : 0;
  return Float64Array.from({ length: Math.max(0, frames - 1) }, (_, frame) => {
    let sum = 0;
    for (let at = frame * width; at < (frame + 1) * width; at += 3) {
      const x = positions[at + width]! - positions[at]!;
      const y = positions[at + width + 1]! - positions[at + 1]!;
      const z = positions[at + width + 2]! - positions[at + 2]!;
      sum += Math.sqrt(x * x + y * y + z * z);
    }
    return (3 * sum) / width;
  });
}

/** Standard deviations at which the filter is cut off, as scipy does. */
const CUT = 4;

/**
 * A Gaussian filter as `scipy.ndimage.gaussian_filter1d`, edges reflected. The sums run in scipy's order, so that two
 * equal values stay equal here where they do there, and no beat is seen in a motion that stands still.
 */
function smoothed(values: Float64Array, deviation: number): Float64Array {
  const radius = Math.floor(CUT * deviation + 0.5);
  const raw = Array.from({ length: radius + 1 }, (_, far) => Math.exp((-0.5 * far * far) / deviation ** 2));
  const total = raw.reduce((sum, weight, far) => sum + (far === 0 ? weight : 2 * weight), 0);
  const weights = raw.map((weight) => weight / total);
  const count = values.length;
  const reflected = (index: number): number => {
    const round = ((index % (2 * count)) + 2 * count) % (2 * count);
    return values[round < count ? round : 2 * count - 1 - round]!;
  };
  return values.map((value, at) => {
    let sum = value * weights[0]!;
    for (let far = radius; far > 0; far--) sum += (reflected(at - far) + reflected(at + far)) * weights[far]!;
    return sum;
  });
}

/**
 * The beats of a motion, its moments of least speed, the accents of a dance: frames at which the smoothed mean joint
 * speed has a strict local minimum. `motion_beats` of training/metrics/beats.py.
 * @param clip any number of joints; fewer than two frames have no beat
 * @param smoothing standard deviation of the filter on the speed, frames; the manifest's
 * @returns frames in ascending order; frame f stands for the step from frame f to f + 1
 */
export function motionBeats(
  { positions, frames }: Pick<MotionClip, 'positions' | 'frames'>,
  smoothing: number,
): number[] {
  const speed = smoothed(meanSpeed(positions, frames), smoothing);
  const beats: number[] = [];
  for (let frame = 1; frame + 1 < speed.length; frame++) {
    if (speed[frame]! < speed[frame - 1]! && speed[frame]! < speed[frame + 1]!) beats.push(frame);
  }
  return beats;
}
