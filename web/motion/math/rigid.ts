import { aboutAxisInto, fromAxesInto, multiplyInto, rotateInverseInto } from './flat-quaternions';
import { AXES, dotAt, directionInto, lengthAt, perpendicularInto } from './flat-vectors';

/** Working memory of the functions below; nothing is kept from call to call. */
const v = new Float64Array(3);
const step = new Float64Array(4);

/** Orientation of a body part from the direction to its left and (roughly) upwards; both are overwritten. */
export function bodyFrameInto(out: Float64Array, o: number, left: Float64Array, up: Float64Array): void {
  directionInto(left, 0, left, 0, AXES, 0);
  perpendicularInto(up, 0, up, 0, left, 0, AXES, 3);
  fromAxesInto(out, o, left, 0, up, 0);
}

/** Vectors of a rigid body part in its own axes. */
export interface RigidPart {
  /** n x 3, metres. */
  readonly rest: Float64Array;
  /** 3 x 3, the inverse of sum |v|^2 I - v v^T over the vectors; zero where they are on one line. */
  readonly inverse: Float64Array;
}

export function rigidPart(rest: Float64Array): RigidPart {
  let [xx, xy, xz, yy, yz, zz] = [0, 0, 0, 0, 0, 0];
  for (let i = 0; i < rest.length; i += 3) {
    const [x, y, z] = [rest[i]!, rest[i + 1]!, rest[i + 2]!];
    xx += y * y + z * z;
    yy += x * x + z * z;
    zz += x * x + y * y;
    xy -= x * y;
    xz -= x * z;
    yz -= y * z;
  }
  const [a, b, c] = [yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy];
  const determinant = xx * a + xy * b + xz * c;
  // Vectors on one line leave the rotation about it undetermined.
  if (Math.abs(determinant) < 1e-18) return { rest, inverse: new Float64Array(9) };
  const [d, e, f] = [xx * zz - xz * xz, xz * xy - xx * yz, xx * yy - xy * xy];
  return { rest, inverse: Float64Array.of(a, b, c, b, d, e, c, e, f).map((value) => value / determinant) };
}

/**
 * The rotation that brings the vectors of a rigid part nearest to the vectors `observed` by least squares (Wahba's
 * problem, 1965). Gauss-Newton on the rotation vector, in the part's own axes, where the matrix of the normal equations
 * is constant: it converges quadratically, so iteration ends with a step below 1e-5 rad.
 *
 * @param rotation with `r`: where the rotation is, at first the one to start from
 * @param observed n x 3, metres
 */
export function fitRotation(
  rotation: Float64Array,
  r: number,
  { rest, inverse }: RigidPart,
  observed: Float64Array,
): void {
  for (let iteration = 0; iteration < 4; iteration++) {
    let [x, y, z] = [0, 0, 0];
    for (let i = 0; i < rest.length; i += 3) {
      rotateInverseInto(v, 0, rotation, r, observed, i);
      x += rest[i + 1]! * v[2]! - rest[i + 2]! * v[1]!;
      y += rest[i + 2]! * v[0]! - rest[i]! * v[2]!;
      z += rest[i]! * v[1]! - rest[i + 1]! * v[0]!;
    }
    v[0] = x;
    v[1] = y;
    v[2] = z;
    x = dotAt(inverse, 0, v, 0);
    y = dotAt(inverse, 3, v, 0);
    z = dotAt(inverse, 6, v, 0);
    v[0] = x;
    v[1] = y;
    v[2] = z;
    const angle = lengthAt(v, 0);
    directionInto(v, 0, v, 0, AXES, 0);
    aboutAxisInto(step, 0, v, 0, angle);
    multiplyInto(rotation, r, rotation, r, step, 0);
    if (angle < 1e-5) break;
  }
}
