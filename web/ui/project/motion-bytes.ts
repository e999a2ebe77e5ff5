import type { SolvedMotion } from '../../motion/skeleton/clip';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';

/** Floats of one skeleton, and of one frame: root, rotations, positions. */
const SKELETON_FLOATS = JOINT_COUNT * 3;
const FRAME_FLOATS = 3 + JOINT_COUNT * 4 + JOINT_COUNT * 3;

/** Bytes of a packed motion. */
export function motionBytes(frames: number): number {
  return 4 * (SKELETON_FLOATS + frames * FRAME_FLOATS);
}

/** A motion as float32, little-endian: offsets, root, rotations, positions, each as in `SolvedMotion`. */
export function packMotion({ offsets, root, rotations, positions }: SolvedMotion): Uint8Array<ArrayBuffer> {
  return packFloats(offsets, root, rotations, positions);
}

/** The parts one after the other as float32, little-endian. */
export function packFloats(...parts: readonly Float32Array[]): Uint8Array<ArrayBuffer> {
  const view = new DataView(new ArrayBuffer(4 * parts.reduce((sum, { length }) => sum + length, 0)));
  let at = 0;
  for (const part of parts)
    for (const value of part) {
      view.setFloat32(at, value, true);
      at += 4;
    }
  return new Uint8Array(view.buffer);
}

/** The values of packed floats, all parts in one array. */
export function unpackFloats({ buffer, byteOffset, byteLength }: Uint8Array): Float32Array {
  const view = new DataView(buffer, byteOffset, byteLength);
  return Float32Array.from({ length: byteLength / 4 }, (_, index) => view.getFloat32(4 * index, true));
}

/** Reads a packed motion. @param bytes `motionBytes(frames)` of them */
export function unpackMotion(
  bytes: Uint8Array,
  { fps, frames, fitError }: Pick<SolvedMotion, 'fps' | 'frames' | 'fitError'>,
): SolvedMotion {
  const values = unpackFloats(bytes);
  let at = 0;
  const next = (length: number): Float32Array => values.slice(at, (at += length));
  return {
    fps,
    frames,
    fitError,
    offsets: next(SKELETON_FLOATS),
    root: next(frames * 3),
    rotations: next(frames * JOINT_COUNT * 4),
    positions: next(frames * JOINT_COUNT * 3),
  };
}
