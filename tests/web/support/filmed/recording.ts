/** What the networks saw in a video, in a small file: only landmarks that the motion is made of, in 16 bits. */
import { readFileSync } from 'node:fs';
import type { Observations } from '../../../../web/video/observations';
import { LANDMARK_COUNT } from '../../../../web/video/pose/landmarks';

/** Landmarks that are kept: ears, trunk, limbs and feet. */
const KEPT = [7, 8, 11, 12, 13, 14, 15, 16, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32] as const;
/** Steps of the numbers that are kept: pixels, metres, shares. */
const PIXEL = 1 / 16;
const METRE = 1 / 8192;
const SHARE = 1 / 32767;
/** Parts of a quaternion below which a camera stands still. */
const STILL = 0.003;

interface Recording {
  readonly width: number;
  readonly height: number;
  /** Seconds from picture to picture, and pictures. */
  readonly spacing: number;
  readonly rows: number;
  /** Sixteen-bit numbers in base64: for each picture presence, centre, then image, world and visibility of `KEPT`. */
  readonly data: string;
  /** The same of the camera's turns, in `SHARE`; left out where the camera stands still. */
  readonly turn?: string;
}

const COLUMNS = 3 + KEPT.length * 6;

type Field = 'presence' | 'centre' | 'image' | 'world' | 'visibility';

/** Each number of a row: where it lies in the observations, and its step. */
function* cells(): Generator<{ field: Field; columns: number; at: number; step: number }> {
  yield { field: 'presence', columns: 1, at: 0, step: SHARE };
  for (const at of [0, 1]) yield { field: 'centre', columns: 2, at, step: PIXEL };
  for (const landmark of KEPT) {
    for (const axis of [0, 1])
      yield { field: 'image', columns: 2 * LANDMARK_COUNT, at: 2 * landmark + axis, step: PIXEL };
    for (const axis of [0, 1, 2])
      yield { field: 'world', columns: 3 * LANDMARK_COUNT, at: 3 * landmark + axis, step: METRE };
    yield { field: 'visibility', columns: LANDMARK_COUNT, at: landmark, step: SHARE };
  }
}

/** @param seen pictures at even spaces of time */
export function encodeRecording(
  seen: Readonly<Record<Exclude<keyof Observations, 'cuts'>, ArrayLike<number> | number>>,
): string {
  const { times, width, height } = seen as unknown as Observations;
  const rows = times.length;
  const numbers = new Int16Array(rows * COLUMNS);
  [...cells()].forEach(({ field, columns, at, step }, column) => {
    const values = seen[field] as ArrayLike<number>;
    for (let row = 0; row < rows; row++)
      numbers[row * COLUMNS + column] = Math.max(-32768, Math.min(32767, values[row * columns + at]! / step));
  });
  const spacing = (times[rows - 1]! - times[0]!) / (rows - 1);
  const base64 = (values: Int16Array): string => Buffer.from(values.buffer).toString('base64');
  const turn = seen.turn as ArrayLike<number>;
  const turns = Int16Array.from({ length: 4 * rows }, (_, i) => Math.round(turn[i]! / SHARE));
  const moved = turns.some((value, i) => i % 4 < 3 && Math.abs(value * SHARE) > STILL);
  const recording = {
    width,
    height,
    spacing,
    rows,
    data: base64(numbers),
    ...(moved && { turn: base64(turns) }),
  };
  return `${JSON.stringify(recording satisfies Recording)}\n`;
}

/** @param name of the recording in tests/fixtures/video */
export function recorded(name: string): Observations {
  const file = new URL(`../../../fixtures/video/${name}.json`, import.meta.url);
  const { width, height, spacing, rows, data, turn } = JSON.parse(readFileSync(file, 'utf8')) as Recording;
  const sixteenBits = (base64: string): Int16Array =>
    new Int16Array(Uint8Array.from(Buffer.from(base64, 'base64')).buffer);
  const numbers = sixteenBits(data);
  const turns = turn === undefined ? null : sixteenBits(turn);
  const out = {
    presence: new Float32Array(rows),
    centre: new Float32Array(rows * 2),
    image: new Float32Array(rows * 2 * LANDMARK_COUNT),
    world: new Float32Array(rows * 3 * LANDMARK_COUNT),
    visibility: new Float32Array(rows * LANDMARK_COUNT),
  };
  [...cells()].forEach(({ field, columns, at, step }, column) => {
    for (let row = 0; row < rows; row++)
      out[field][row * columns + at] = numbers[row * COLUMNS + column]! * step;
  });
  return {
    width,
    height,
    times: Float64Array.from({ length: rows }, (_, row) => row * spacing),
    ...out,
    turn: Float32Array.from({ length: 4 * rows }, (_, i) =>
      turns ? turns[i]! * SHARE : Number(i % 4 === 3),
    ),
    cuts: [],
    brightest: 1,
  };
}
