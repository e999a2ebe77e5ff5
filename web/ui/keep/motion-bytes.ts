import type { SolvedMotion } from '../../motion/clip';
import { JOINT_COUNT } from '../../motion/skeleton';

/** Numbers of one skeleton, and of one frame: root, rotations, positions. */
const SKELETON = JOINT_COUNT * 3;
const FRAME = 3 + JOINT_COUNT * 4 + JOINT_COUNT * 3;

/** Bytes of a packed motion of so many frames. */
export const MOTION_BYTES = (frames: number): number => 4 * (SKELETON + frames * FRAME);

/** A motion as float32, little-endian: offsets, root, rotations, positions, each as in `SolvedMotion`. */
export function packMotion({ offsets, root, rotations, positions }: SolvedMotion): Uint8Array<ArrayBuffer> {
  const view = new DataView(
    new ArrayBuffer(4 * [offsets, root, rotations, positions].reduce((sum, { length }) => sum + length, 0)),
  );
  let at = 0;
  for (const part of [offsets, root, rotations, positions])
    for (const value of part) {
      view.setFloat32(at, value, true);
      at += 4;
    }
  return new Uint8Array(view.buffer);
}

/** @param bytes as many as `MOTION_BYTES(frames)` */
export function unpackMotion(
  bytes: Uint8Array,
  { fps, frames, fitError }: Pick<SolvedMotion, 'fps' | 'frames' | 'fitError'>,
): SolvedMotion {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 0;
  const take = (length: number): Float32Array => {
    const part = new Float32Array(length);
    for (let i = 0; i < length; i++, at += 4) part[i] = view.getFloat32(at, true);
    return part;
  };
  return {
    fps,
    frames,
    fitError,
    offsets: take(SKELETON),
    root: take(frames * 3),
    rotations: take(frames * JOINT_COUNT * 4),
    positions: take(frames * JOINT_COUNT * 3),
  };
}
