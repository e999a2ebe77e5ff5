import type { SolvedMotion } from '../../../motion/skeleton/clip';

/** Speed of a dancer in each frame: the mean over the joints, m/s, smoothed over about 0.2 s. */
export function speedCurve({
  positions,
  frames,
  fps,
}: Pick<SolvedMotion, 'positions' | 'frames' | 'fps'>): Float32Array {
  const width = frames > 0 ? positions.length / frames : 0;
  const joints = width / 3;
  const raw = new Float32Array(frames);
  for (let frame = 1; frame < frames; frame++) {
    let sum = 0;
    for (let joint = 0; joint < joints; joint++) {
      const at = frame * width + joint * 3;
      let square = 0;
      for (let axis = 0; axis < 3; axis++) {
        const step = (positions[at + axis] ?? 0) - (positions[at + axis - width] ?? 0);
        square += step * step;
      }
      sum += Math.sqrt(square);
    }
    raw[frame] = (sum / joints) * fps;
  }
  raw[0] = raw[1] ?? 0;
  return smooth(raw, Math.max(1, Math.round(fps / 15)));
}

/** A moving average over `radius` frames to either side, applied twice, which is close to a Gaussian filter. */
function smooth(values: Float32Array, radius: number): Float32Array {
  let from = values;
  for (let pass = 0; pass < 2; pass++) {
    const to = new Float32Array(from.length);
    let sum = 0;
    for (let i = -radius; i < from.length; i++) {
      sum += from[i + radius] ?? 0;
      if (i >= 0) {
        const first = Math.max(0, i - radius);
        const last = Math.min(from.length - 1, i + radius);
        to[i] = sum / (last - first + 1);
      }
      sum -= from[i - radius] ?? 0;
    }
    from = to;
  }
  return from;
}
