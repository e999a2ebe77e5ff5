import { FPS } from '../../motion/skeleton/clip';
import { runsOf } from '../../motion/math/statistics';
import type { Observations } from '../observations';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { MIN_SIGHTING } from '../pose/tracker';

/** Longest time without the person that is bridged without a word, seconds. */
export const MAX_BRIDGE = 0.5;

/** A part of a video, seconds. */
export interface Part {
  readonly start: number;
  readonly end: number;
}

/** A span in which the person was not seen, seconds from the first frame. */
export interface Gap {
  readonly start: number;
  readonly end: number;
}

/** Observations at 30 fps without gaps, from the first to the last picture in which the person is seen. */
export interface Series {
  readonly width: number;
  readonly height: number;
  readonly frames: number;
  /** Time of the first frame, seconds of the video. */
  readonly start: number;
  /** frames x 33 x 2, pixels. */
  readonly image: Float64Array;
  /** frames x 33 x 3, metres. */
  readonly world: Float64Array;
  /** frames x 33, 0 to 1. */
  readonly visibility: Float64Array;
  /** frames x 2, pixels. */
  readonly centre: Float64Array;
  /** frames x 4, as in the observations. */
  readonly turn: Float64Array;
  /** 1 where the person is seen, 0 where the frame is bridged. */
  readonly seen: Uint8Array;
  /** All spans that were bridged; those longer than `MAX_BRIDGE` are guesses. */
  readonly gaps: readonly Gap[];
}

/**
 * The pictures in which the person is seen, without those of short sightings far from all others in time: there something
 * else was taken for a person. A person who is never seen for longer keeps them all.
 * @param trim part of the video to take, seconds; null takes all of it
 * @returns rows of the observations, ascending
 */
export function rowsSeen({ times, presence }: Observations, trim: Part | null = null): readonly number[] {
  const rows = [...presence.keys()].filter(
    (row) => presence[row]! > 0 && (!trim || (times[row]! >= trim.start && times[row]! <= trim.end)),
  );
  const sightings: number[][] = [];
  for (const row of rows) {
    const last = sightings.at(-1);
    if (last && times[row]! - times[last.at(-1)!]! <= MAX_BRIDGE) last.push(row);
    else sightings.push([row]);
  }
  const long = sightings.filter((rows) => times[rows.at(-1)!]! - times[rows[0]!]! >= MIN_SIGHTING);
  return long.length > 0 ? long.flat() : rows;
}

/**
 * Resamples observations to 30 fps by linear interpolation between the pictures in which the person is seen.
 * @param trim part of the video to take, seconds; null takes all of it
 * @returns null when the person is in fewer than two pictures
 */
export function seriesOf(observations: Observations, trim: Part | null = null): Series | null {
  const { times, width, height } = observations;
  const rows = rowsSeen(observations, trim);
  const [first, last] = [rows[0], rows.at(-1)];
  if (first === undefined || last === undefined || times[last]! - times[first]! < 1 / FPS) return null;
  const start = times[first]!;
  const frames = Math.floor((times[last]! - start) * FPS + 1e-6) + 1;
  const columns = {
    image: 2 * LANDMARK_COUNT,
    world: 3 * LANDMARK_COUNT,
    visibility: LANDMARK_COUNT,
    centre: 2,
    turn: 4,
  };
  const out = {
    image: new Float64Array(frames * columns.image),
    world: new Float64Array(frames * columns.world),
    visibility: new Float64Array(frames * columns.visibility),
    centre: new Float64Array(frames * columns.centre),
    turn: new Float64Array(frames * columns.turn),
  };
  const seen = new Uint8Array(frames);
  const spacing = typicalSpacing(times);
  let after = 1;
  for (let frame = 0; frame < frames; frame++) {
    const time = start + frame / FPS;
    while (after < rows.length - 1 && times[rows[after]!]! < time) after++;
    const [a, b] = [rows[after - 1]!, rows[after]!];
    const span = times[b]! - times[a]!;
    const share = Math.min(1, Math.max(0, (time - times[a]!) / span));
    seen[frame] = Number(span < 2.5 * spacing || share < 0.01 || share > 0.99);
    for (const name of ['image', 'world', 'visibility', 'centre', 'turn'] as const) {
      const [from, size] = [observations[name], columns[name]];
      for (let i = 0; i < size; i++) {
        const value = from[a * size + i]!;
        out[name][frame * size + i] = value + (from[b * size + i]! - value) * share;
      }
    }
  }
  const unseen = runsOf(Array.from(seen, (flag) => flag === 0));
  const gaps = unseen.map(({ from, to }) => ({ start: from / FPS, end: to / FPS }));
  return { width, height, frames, start, ...out, seen, gaps };
}

/** Median time between two pictures, seconds. */
function typicalSpacing(times: Float64Array): number {
  const steps = times.slice(1).map((time, i) => time - times[i]!);
  return steps.sort()[steps.length >> 1] ?? 1 / FPS;
}
