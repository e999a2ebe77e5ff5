import type { SolvedMotion } from '../motion/clip';

/** Loudness of a song as seen: per column the lowest and the highest sample. */
export interface Peaks {
  readonly low: Float32Array;
  readonly high: Float32Array;
}

/**
 * The picture of a waveform.
 * @param pcm mono samples
 * @param rate samples per second
 * @param seconds length of the picture; past the song's end it is flat
 * @param columns width of the picture
 */
export function peaks(pcm: Float32Array, rate: number, seconds: number, columns: number): Peaks {
  const low = new Float32Array(columns);
  const high = new Float32Array(columns);
  const samples = seconds * rate;
  for (let column = 0; column < columns; column++) {
    const from = Math.floor((column / columns) * samples);
    const to = Math.min(pcm.length, Math.max(from + 1, Math.floor(((column + 1) / columns) * samples)));
    let least = 0;
    let most = 0;
    for (let i = from; i < to; i++) {
      const value = pcm[i] ?? 0;
      if (value < least) least = value;
      if (value > most) most = value;
    }
    low[column] = least;
    high[column] = most;
  }
  return { low, high };
}

/** Speed of a dancer as drawn in its lane: mean over the joints in m/s per frame, smoothed over about 0.2 s. */
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

/** A running mean over `radius` frames to either side, twice, which is close to a Gaussian. */
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
