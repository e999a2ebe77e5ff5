import { readAccessor } from './accessor';
import { damagedGltf, type Gltf, type GltfFile } from './container';
import { ASSUMED_FPS, nearestRate } from '../../retarget/frame-rate';
import { normaliseQuat, type Quat, slerp } from '../../math/quat';
import { keyBefore } from '../../math/key-before';

/** Values of one property of a node over time. */
interface Track {
  readonly times: Float32Array;
  readonly values: Float32Array;
  /** Numbers in a value: 3, or 4 for a rotation. */
  readonly width: number;
  readonly interpolation: string;
}

/** Most by which a time in single precision is wrong, seconds: a frame on a key may seem to come before it. */
const TIME_ROUNDING = 1e-4;

/** Tracks by node and property: `3 rotation`. */
export type Tracks = ReadonlyMap<string, Track>;

const WIDTHS: Readonly<Record<string, number>> = { translation: 3, rotation: 4, scale: 3 };

/** The tracks of a clip. @throws {AppError} `unreadable-file` */
export function tracksOf(file: GltfFile, clip: Gltf['animations'][number]): Tracks {
  const tracks = new Map<string, Track>();
  for (const { sampler, target } of clip.channels) {
    const width = WIDTHS[target.path];
    const source = clip.samplers[sampler];
    if (width === undefined || target.node === undefined) continue;
    if (!source) throw damagedGltf('a channel of its animation has no values');
    const times = readAccessor(file, source.input);
    const values = readAccessor(file, source.output);
    const rows = source.interpolation === 'CUBICSPLINE' ? 3 * times.length : times.length;
    if (times.length === 0 || values.length !== rows * width || !isRising(times))
      throw damagedGltf('times and values of its animation do not match');
    tracks.set(`${target.node} ${target.path}`, {
      times,
      values,
      width,
      interpolation: source.interpolation,
    });
  }
  return tracks;
}

/** Whether tracks move a node. */
export function movesNode(tracks: Tracks, node: number): boolean {
  return Object.keys(WIDTHS).some((path) => (tracks.get(`${node} ${path}`)?.times.length ?? 0) > 1);
}

const isRising = (times: Float32Array): boolean => times.every((time, i) => i === 0 || time >= times[i - 1]!);

/** Length of a clip and its frame rate: that of its densest track where that is a usual one, else `ASSUMED_FPS`. */
export function timingOf(tracks: Tracks): { start: number; frames: number; fps: number } {
  let [start, end, step] = [Infinity, -Infinity, Infinity];
  for (const { times } of tracks.values()) {
    const [first, last] = [times[0]!, times.at(-1)!];
    start = Math.min(start, first);
    end = Math.max(end, last);
    if (times.length > 2) step = Math.min(step, (last - first) / (times.length - 1));
  }
  const dense = nearestRate(1 / step);
  const fps = dense !== null && dense >= 20 ? dense : ASSUMED_FPS;
  return { start, frames: end > start ? Math.floor((end - start) * fps + 1e-3) + 1 : 0, fps };
}

/** The value of a track at a time, interpolated as its file says. */
export function valueAt(track: Track, time: number): number[] {
  const { times, values, width, interpolation } = track;
  const cubic = interpolation === 'CUBICSPLINE';
  const row = (key: number, part = 0): number[] => {
    const at = (cubic ? 3 * key + part : key) * width;
    return [...values.subarray(at, at + width)];
  };
  // The middle of the three values of a key of a cubic spline; the others are its tangents.
  const value = (key: number): number[] => row(key, 1);
  const last = times.length - 1;
  if (time <= times[0]!) return value(0);
  if (time >= times[last]!) return value(last);
  const low = keyBefore(times, time);
  const high = low + 1;
  const span = times[high]! - times[low]!;
  const t = span > 0 ? (time - times[low]!) / span : 0;
  if (interpolation === 'STEP') return value(times[high]! - time < TIME_ROUNDING ? high : low);
  const [a, b] = [value(low), value(high)];
  if (cubic) {
    const [out, into] = [row(low, 2), row(high, 0)];
    const mixed = a.map(
      (start, i) =>
        (2 * t ** 3 - 3 * t ** 2 + 1) * start +
        (t ** 3 - 2 * t ** 2 + t) * span * out[i]! +
        (-2 * t ** 3 + 3 * t ** 2) * b[i]! +
        (t ** 3 - t ** 2) * span * into[i]!,
    );
    return width === 4 ? [...normaliseQuat(mixed as unknown as Quat)] : mixed;
  }
  if (width === 4) {
    const ends = [a, b].map((end) => normaliseQuat(end as unknown as Quat)) as [Quat, Quat];
    return [...slerp(ends[0], ends[1], t)];
  }
  return a.map((start, i) => start + (b[i]! - start) * t);
}
