import { AppError } from '../../../common/error';
import { normaliseQuat, type Quat } from '../../math/quat';
import type { Vec3 } from '../../math/vec3';

/** Control points of a Bézier curve from (0, 0) to (1, 1): x1, y1, x2, y2 in 0 to 1. */
export type Bezier = readonly [number, number, number, number];

/** A key of a bone: move and turn from its rest pose, right-handed, and the curves that lead to it. */
export interface Key {
  readonly frame: number;
  readonly move: Vec3;
  readonly turn: Quat;
  /** Curves of x, y, z and of the rotation. */
  readonly curves: readonly [Bezier, Bezier, Bezier, Bezier];
}

export interface Vmd {
  /** Keys by bone, in the order of their frames. */
  readonly bones: ReadonlyMap<string, readonly Key[]>;
  /** Whether the inverse kinematics of a bone is on, from a frame on. */
  readonly switches: readonly { readonly frame: number; readonly bone: string; readonly on: boolean }[];
}

const NAME_BYTES = 15;
const BONE_BYTES = 111;
/** Sizes of the keys of faces, camera, lights and shadows, which come between bones and switches. */
const OTHER_BYTES = [23, 61, 28, 9];
/** Largest number of keys of bones. */
const MAX_KEYS = 1e6;
/** Last frame that a key may have: ten minutes at 30 frames per second. */
const MAX_FRAME = 18_000;

/** The error of a file that is not as VMD says. */
function damagedVmd(what: string): AppError {
  return new AppError('unreadable-file', `The VMD file is damaged: ${what}.`, 'Download or copy it again.');
}

function readKey(view: DataView, at: number): Key {
  const float = (place: number): number => view.getFloat32(at + place, true);
  const values = Array.from({ length: 7 }, (_, i) => float(19 + 4 * i));
  if (!values.every((value) => Math.abs(value) < 1e5)) throw damagedVmd('a key holds no usable number');
  const [x, y, z, qx, qy, qz, qw] = values as [number, number, number, number, number, number, number];
  const byte = (i: number): number => Math.min(127, view.getUint8(at + 47 + i)) / 127;
  // Bytes 2 and 3 of the first row may hold a switch of physics; the second row repeats the first, moved by one.
  const curve = (axis: number): Bezier => [
    byte(axis < 2 ? axis : 15 + axis),
    byte(4 + axis),
    byte(8 + axis),
    byte(12 + axis),
  ];
  return {
    frame: view.getUint32(at + NAME_BYTES, true),
    // MMD is left-handed with z to the back.
    move: [x, y, -z],
    turn: normaliseQuat([-qx, -qy, qz, qw]),
    curves: [curve(0), curve(1), curve(2), curve(3)],
  };
}

/**
 * Reads a VMD file: the keys of bones, and the switches of inverse kinematics.
 *
 * @throws {AppError} `unreadable-file`, `no-motion` or `too-long`
 */
export function readVmdFile(bytes: Uint8Array): Vmd {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const decoder = new TextDecoder('shift_jis');
  const text = (at: number, length: number): string => {
    const field = bytes.subarray(at, at + length);
    const end = field.indexOf(0);
    return decoder.decode(end < 0 ? field : field.subarray(0, end));
  };
  // The first version has a shorter name of its model.
  const start = 30 + (text(0, 30).includes('0002') ? 20 : 10);
  if (bytes.length < start + 4) throw damagedVmd('it ends within its head');
  const count = view.getUint32(start, true);
  if (count > MAX_KEYS || start + 4 + count * BONE_BYTES > bytes.length)
    throw damagedVmd(`it states ${count} keys and ends before them`);
  if (count === 0) {
    throw new AppError(
      'no-motion',
      'The VMD file moves no bones; it may be of a camera or a face.',
      'Choose the VMD file of the dancer’s body.',
    );
  }
  const bones = new Map<string, Key[]>();
  for (let i = 0; i < count; i++) {
    const at = start + 4 + i * BONE_BYTES;
    const name = text(at, NAME_BYTES);
    const key = readKey(view, at);
    if (key.frame > MAX_FRAME) {
      throw new AppError(
        'too-long',
        `The VMD file has a key at frame ${key.frame}; up to ${MAX_FRAME} are read, ten minutes.`,
        'Cut the motion to the dance.',
      );
    }
    const keys = bones.get(name);
    if (keys) keys.push(key);
    else bones.set(name, [key]);
  }
  for (const keys of bones.values()) keys.sort((a, b) => a.frame - b.frame);
  return { bones, switches: switchesOf(view, text, start + 4 + count * BONE_BYTES) };
}

/** The switches at the end of the file; none where it ends earlier, as older programs write it. */
function switchesOf(
  view: DataView,
  text: (at: number, length: number) => string,
  from: number,
): Vmd['switches'] {
  let at = from;
  for (const size of OTHER_BYTES) {
    if (at + 4 > view.byteLength) return [];
    at += 4 + view.getUint32(at, true) * size;
  }
  const switches: { frame: number; bone: string; on: boolean }[] = [];
  if (at + 4 > view.byteLength) return [];
  const count = Math.min(MAX_KEYS, view.getUint32(at, true));
  at += 4;
  for (let i = 0; i < count && at + 9 <= view.byteLength; i++) {
    const [frame, bones] = [view.getUint32(at, true), view.getUint32(at + 5, true)];
    at += 9;
    for (let bone = 0; bone < bones && at + 21 <= view.byteLength; bone++, at += 21)
      switches.push({ frame, bone: text(at, 20), on: view.getUint8(at + 20) !== 0 });
  }
  return switches.sort((a, b) => a.frame - b.frame);
}
