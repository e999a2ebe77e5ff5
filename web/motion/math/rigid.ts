import { fromAxes, type Quat } from './quat';
import { conjugateRow, multiplyRows, rotateRow } from './rows';
import { cross, direction, dot, perpendicular, scale, type Vec3, X_AXIS, Y_AXIS } from './vec3';

/** Orientation of a body part from the direction to its left and (roughly) upwards. */
export function bodyFrame(left: Vec3, up: Vec3): Quat {
  const x = direction(left, X_AXIS);
  return fromAxes(x, perpendicular(up, x, Y_AXIS));
}

/** Vectors of a rigid body part in its own axes. */
export interface RigidPart {
  /** n x 3, metres. */
  readonly rest: Float64Array;
  /** 3 x 3, the inverse of sum |v|^2 I - v v^T over these vectors v; zero where they are on one line. */
  readonly inverse: Float64Array;
}

export function rigidPart(vectors: readonly Vec3[]): RigidPart {
  let [xx, xy, xz, yy, yz, zz] = [0, 0, 0, 0, 0, 0];
  for (const [x, y, z] of vectors) {
    xx += y * y + z * z;
    yy += x * x + z * z;
    zz += x * x + y * y;
    xy -= x * y;
    xz -= x * z;
    yz -= y * z;
  }
  const [a, b, c]: [Vec3, Vec3, Vec3] = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  const determinant = dot(a, cross(b, c));
  // Vectors on one line leave the rotation about it undetermined.
  const factor = Math.abs(determinant) < 1e-18 ? 0 : 1 / determinant;
  const rows = [cross(b, c), cross(c, a), cross(a, b)].map((row) => scale(row, factor));
  return { rest: Float64Array.from(vectors.flat()), inverse: Float64Array.from(rows.flat()) };
}

/** Working memory of `fitRotation`: the inverse of the rotation, a vector in the part's own axes, and a step. */
const back = new Float64Array(4);
const vector = new Float64Array(3);
const turn = new Float64Array(4);

/**
 * The rotation that brings the vectors of a rigid part nearest to the vectors `observed` (n x 3) by least squares
 * (Wahba's problem, 1965). Gauss-Newton on the rotation vector, in the part's own axes, where the matrix of the normal
 * equations is constant: it converges quadratically, so iteration ends with a step below 1e-5 rad.
 *
 * @param rotation one row, the rotation to start from; becomes the result
 */
export function fitRotation(
  rotation: Float64Array,
  { rest, inverse }: RigidPart,
  observed: Float64Array,
): void {
  for (let step = 0; step < 4; step++) {
    conjugateRow(back, 0, rotation, 0);
    let tx = 0;
    let ty = 0;
    let tz = 0;
    for (let i = 0; i < rest.length; i += 3) {
      rotateRow(vector, 0, back, 0, observed, i / 3);
      tx += rest[i + 1]! * vector[2]! - rest[i + 2]! * vector[1]!;
      ty += rest[i + 2]! * vector[0]! - rest[i]! * vector[2]!;
      tz += rest[i]! * vector[1]! - rest[i + 1]! * vector[0]!;
    }
    const x = inverse[0]! * tx + inverse[1]! * ty + inverse[2]! * tz;
    const y = inverse[3]! * tx + inverse[4]! * ty + inverse[5]! * tz;
    const z = inverse[6]! * tx + inverse[7]! * ty + inverse[8]! * tz;
    const angle = Math.sqrt(x * x + y * y + z * z);
    const share = angle > 0 ? Math.sin(angle / 2) / angle : 0;
    turn[0] = x * share;
    turn[1] = y * share;
    turn[2] = z * share;
    turn[3] = Math.cos(angle / 2);
    multiplyRows(rotation, 0, rotation, 0, turn, 0);
    if (angle < 1e-5) break;
  }
}
