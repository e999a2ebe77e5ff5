import type { Quat } from '../../../../web/motion/math/quat';
import type { Vec3 } from '../../../../web/motion/math/vec3';

/** A key of a bone, right-handed, as the reader gives it. */
export interface MadeKey {
  readonly bone: string;
  readonly frame: number;
  readonly move?: Vec3;
  readonly turn?: Quat;
  /** x1, y1, x2, y2 of all curves, 0 to 127; a line where it is left out. */
  readonly curve?: Curve;
  /** Those of x, y, z and the rotation, where they differ. */
  readonly curves?: readonly [Curve, Curve, Curve, Curve];
}

type Curve = readonly [number, number, number, number];

/** Bytes of each character in Shift-JIS, found by decoding all pairs. */
const SHIFT_JIS = new Map<string, readonly number[]>();
{
  const decoder = new TextDecoder('shift_jis');
  for (let first = 0x81; first < 0xfd; first++)
    for (let second = 0x40; second < 0xfd; second++) {
      const letter = decoder.decode(Uint8Array.of(first, second));
      if (letter.length === 1 && !SHIFT_JIS.has(letter)) SHIFT_JIS.set(letter, [first, second]);
    }
}

const encoded = (name: string): number[] =>
  [...name].flatMap((letter) => (letter < '\u0080' ? [letter.charCodeAt(0)] : SHIFT_JIS.get(letter)!));

/** Keys of bones, and switches of inverse kinematics, as a VMD file. */
export function writeVmd(
  keys: readonly MadeKey[],
  switches: readonly { readonly frame: number; readonly bone: string; readonly on: boolean }[] = [],
): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(54 + 111 * keys.length + 16 + 4 + switches.length * 30);
  const view = new DataView(out.buffer);
  out.set(new TextEncoder().encode('Vocaloid Motion Data 0002'));
  view.setUint32(50, keys.length, true);
  keys.forEach(({ bone, frame, move = [0, 0, 0], turn = [0, 0, 0, 1], ...key }, i) => {
    const at = 54 + 111 * i;
    const { curve = [20, 20, 107, 107], curves = [curve, curve, curve, curve] } = key;
    out.set(encoded(bone), at);
    view.setUint32(at + 15, frame, true);
    const values = [move[0], move[1], -move[2], -turn[0], -turn[1], turn[2], turn[3]];
    values.forEach((value, place) => view.setFloat32(at + 19 + 4 * place, value, true));
    const row = [0, 1, 2, 3].flatMap((point) => curves.map((one) => one[point]!));
    // Every row repeats the first one, moved by one more; the first has a switch of physics in its bytes 2 and 3.
    for (let shift = 0; shift < 4; shift++) out.set(row.slice(shift), at + 47 + 16 * shift);
    out.set([0x63, 0x0f], at + 49);
  });
  let at = 54 + 111 * keys.length + 16;
  view.setUint32(at, switches.length, true);
  at += 4;
  for (const { frame, bone, on } of switches) {
    view.setUint32(at, frame, true);
    out[at + 4] = 1;
    view.setUint32(at + 5, 1, true);
    out.set(encoded(bone), at + 9);
    out[at + 29] = Number(on);
    at += 30;
  }
  return out;
}
