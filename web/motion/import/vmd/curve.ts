import type { Bezier, Key } from './file';
import { keyBefore } from '../../math/key-before';
import { IDENTITY, type Quat, slerp } from '../../math/quat';
import { type Vec3, ZERO } from '../../math/vec3';

/** Halvings with which the parameter of a curve is found: to a hundred-thousandth. */
const STEPS = 18;

/** The height of a Bézier curve at a share of its width. */
function eased([x1, y1, x2, y2]: Bezier, share: number): number {
  if (x1 === y1 && x2 === y2) return share;
  const at = (a: number, b: number, t: number): number =>
    3 * (1 - t) ** 2 * t * a + 3 * (1 - t) * t ** 2 * b + t ** 3;
  let [low, high] = [0, 1];
  for (let step = 0; step < STEPS; step++) {
    const middle = (low + high) / 2;
    if (at(x1, x2, middle) < share) low = middle;
    else high = middle;
  }
  return at(y1, y2, (low + high) / 2);
}

/** Move and turn of a bone in a frame; at rest without keys. */
export function poseAt(keys: readonly Key[] | undefined, frame: number): { move: Vec3; turn: Quat } {
  const [first] = keys ?? [];
  if (!keys || !first) return { move: ZERO, turn: IDENTITY };
  const last = keys.at(-1)!;
  if (frame <= first.frame) return first;
  if (frame >= last.frame) return last;
  const key = keyBefore(keys, frame, (one) => one.frame);
  const [a, b] = [keys[key]!, keys[key + 1]!];
  const share = (frame - a.frame) / (b.frame - a.frame);
  const axis = (i: 0 | 1 | 2): number => a.move[i] + (b.move[i] - a.move[i]) * eased(b.curves[i], share);
  return { move: [axis(0), axis(1), axis(2)], turn: slerp(a.turn, b.turn, eased(b.curves[3], share)) };
}
