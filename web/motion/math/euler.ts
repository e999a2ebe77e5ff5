import { normaliseQuat, type Quat } from './quat';
import type { Vec3 } from './vec3';

const TURN = 2 * Math.PI;

/**
 * Angles z, x, y in radians with rotation = Rz Rx Ry (the channel order Zrotation Xrotation Yrotation), x within a
 * quarter turn. Where x is a quarter turn, z and y turn about one axis and `before` (z, x, y) decides between them.
 */
function anglesZxy(q: Quat, before: Vec3): Vec3 {
  // Near the quarter turn a length that is off by a float32's last bit would spoil z and y.
  const [x, y, z, w] = normaliseQuat(q);
  // Elements of the rotation matrix that the order ZXY needs.
  const m21 = 2 * (y * z + x * w);
  if (Math.abs(m21) > 1 - 1e-8) {
    const sign = Math.sign(m21);
    const sum = Math.atan2(2 * (x * y + z * w), 1 - 2 * (y * y + z * z));
    return [sum - sign * before[2], (sign * Math.PI) / 2, before[2]];
  }
  return [
    Math.atan2(2 * (z * w - x * y), 1 - 2 * (x * x + z * z)),
    Math.asin(m21),
    Math.atan2(2 * (y * w - x * z), 1 - 2 * (x * x + y * y)),
  ];
}

function nearest(angle: number, before: number): number {
  return angle - TURN * Math.round((angle - before) / TURN);
}

/**
 * Angles z, x, y in radians of a rotation = Rz Rx Ry, nearest to those of the frame before: no jumps by full turns,
 * and of the two triples that write the same rotation the one that moves less.
 */
export function eulerZxy(q: Quat, before: Vec3): Vec3 {
  const [z, x, y] = anglesZxy(q, before);
  const pick = (a: number, b: number, c: number): Vec3 => [
    nearest(a, before[0]),
    nearest(b, before[1]),
    nearest(c, before[2]),
  ];
  const first = pick(z, x, y);
  const second = pick(z + Math.PI, Math.PI - x, y + Math.PI);
  const moved = (angles: Vec3): number =>
    angles.reduce((sum, angle, i) => sum + Math.abs(angle - before[i]!), 0);
  return moved(first) <= moved(second) ? first : second;
}
