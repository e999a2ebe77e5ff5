import { normaliseQuat, type Quat } from './quat';
import type { Vec3 } from './vec3';

const FULL_TURN = 2 * Math.PI;

/**
 * Angles z, x, y in radians with rotation = Rz Rx Ry (the channel order Zrotation Xrotation Yrotation), x within a
 * quarter turn. At the gimbal lock, where x is a quarter turn, y is that of `before` (z, x, y).
 */
function anglesZxy(q: Quat, before: Vec3): Vec3 {
  // Near the gimbal lock a length that is off by a float32's last bit would spoil z and y.
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

/** The angle plus the full turns that bring it nearest to `before`. */
function unwrap(angle: number, before: number): number {
  return angle - FULL_TURN * Math.round((angle - before) / FULL_TURN);
}

/**
 * Angles z, x, y in radians of a rotation = Rz Rx Ry, unwrapped against those of the frame before: no jumps by full
 * turns, and of the two triples of the same rotation the one that changes less.
 */
export function eulerZxy(q: Quat, before: Vec3): Vec3 {
  const [z, x, y] = anglesZxy(q, before);
  const unwrapped = (a: number, b: number, c: number): Vec3 => [
    unwrap(a, before[0]),
    unwrap(b, before[1]),
    unwrap(c, before[2]),
  ];
  const first = unwrapped(z, x, y);
  const second = unwrapped(z + Math.PI, Math.PI - x, y + Math.PI);
  const moved = (angles: Vec3): number =>
    angles.reduce((sum, angle, i) => sum + Math.abs(angle - before[i]!), 0);
  return moved(first) <= moved(second) ? first : second;
}
