import { aboutAxis, fromAxes, multiply, normaliseQuat, type Quat, rotate } from './quat';
import { add, cross, direction, dot, length, perpendicular, type Vec3, X_AXIS, Y_AXIS, ZERO } from './vec3';

/** Orientation of a body part from the direction to its left and (roughly) upwards. */
export function bodyFrame(left: Vec3, up: Vec3): Quat {
  const x = direction(left, X_AXIS);
  return fromAxes(x, perpendicular(up, x, Y_AXIS));
}

/**
 * The turn that brings the vectors `rest` as near as possible to the vectors `seen` (least squares), beginning at
 * `start`. Gauss-Newton on the rotation vector: it converges quadratically, so a step of
 * 1e-5 rad is the last one that matters.
 */
export function fitTurn(rest: readonly Vec3[], seen: readonly Vec3[], start: Quat): Quat {
  let turn = start;
  for (let step = 0; step < 4; step++) {
    // Normal equations: sum (|v|^2 I - v v^T) omega = sum v x seen, with v the turned rest vectors.
    let [xx, xy, xz, yy, yz, zz] = [0, 0, 0, 0, 0, 0];
    let torque: Vec3 = ZERO;
    for (let i = 0; i < rest.length; i++) {
      const v = rotate(turn, rest[i]!);
      torque = add(torque, cross(v, seen[i]!));
      xx += v[1] * v[1] + v[2] * v[2];
      yy += v[0] * v[0] + v[2] * v[2];
      zz += v[0] * v[0] + v[1] * v[1];
      xy -= v[0] * v[1];
      xz -= v[0] * v[2];
      yz -= v[1] * v[2];
    }
    const columns: [Vec3, Vec3, Vec3] = [
      [xx, xy, xz],
      [xy, yy, yz],
      [xz, yz, zz],
    ];
    const [a, b, c] = columns;
    const determinant = dot(a, cross(b, c));
    // Vectors on one line fix no turn about that line.
    if (Math.abs(determinant) < 1e-18) return turn;
    const omega: Vec3 = [
      dot(torque, cross(b, c)) / determinant,
      dot(torque, cross(c, a)) / determinant,
      dot(torque, cross(a, b)) / determinant,
    ];
    const angle = length(omega);
    turn = normaliseQuat(multiply(aboutAxis(direction(omega, X_AXIS), angle), turn));
    if (angle < 1e-5) break;
  }
  return turn;
}
