import { aboutAxis, fromAxes, multiply, normaliseQuat, type Quat, rotate } from './quat';
import { add, cross, direction, dot, length, perpendicular, type Vec3, X_AXIS, Y_AXIS, ZERO } from './vec3';

/** Orientation of a body part from the direction to its left and (roughly) upwards. */
export function bodyFrame(left: Vec3, up: Vec3): Quat {
  const x = direction(left, X_AXIS);
  return fromAxes(x, perpendicular(up, x, Y_AXIS));
}

/**
 * The rotation that brings the vectors `rest` nearest to the vectors `observed` by least squares (Wahba's problem, 1965).
 * Gauss-Newton on the rotation vector from `start`: it converges quadratically, so iteration ends with a step below
 * 1e-5 rad.
 */
export function fitRotation(rest: readonly Vec3[], observed: readonly Vec3[], start: Quat): Quat {
  let rotation = start;
  for (let step = 0; step < 4; step++) {
    // Normal equations: sum (|v|^2 I - v v^T) omega = sum v x observed, with v the rotated rest vectors.
    let [xx, xy, xz, yy, yz, zz] = [0, 0, 0, 0, 0, 0];
    let torque: Vec3 = ZERO;
    for (let i = 0; i < rest.length; i++) {
      const v = rotate(rotation, rest[i]!);
      torque = add(torque, cross(v, observed[i]!));
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
    // Vectors on one line leave the rotation about it undetermined.
    if (Math.abs(determinant) < 1e-18) return rotation;
    const omega: Vec3 = [
      dot(torque, cross(b, c)) / determinant,
      dot(torque, cross(c, a)) / determinant,
      dot(torque, cross(a, b)) / determinant,
    ];
    const angle = length(omega);
    rotation = normaliseQuat(multiply(aboutAxis(direction(omega, X_AXIS), angle), rotation));
    if (angle < 1e-5) break;
  }
  return rotation;
}
