/**
 * Unit quaternions xyzw inside flat arrays, for loops over thousands of frames; quat.ts has tuples for single values.
 * Operands and results are as in flat-vectors.ts.
 */
import { anyPerpendicularInto, dotAt } from './flat-vectors';

/** Writes xyzw divided by its length. */
function normalisedInto(out: Float64Array, o: number, x: number, y: number, z: number, w: number): void {
  const size = Math.sqrt(x * x + y * y + z * z + w * w);
  out[o] = size > 0 ? x / size : 0;
  out[o + 1] = size > 0 ? y / size : 0;
  out[o + 2] = size > 0 ? z / size : 0;
  out[o + 3] = size > 0 ? w / size : 1;
}

/** The rotation b followed by a. */
export function multiplyInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
): void {
  productInto(out, o, a[i]!, a[i + 1]!, a[i + 2]!, a[i + 3]!, b, j);
}

/** The rotation b followed by the inverse of a. */
export function multiplyInverseInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
): void {
  productInto(out, o, -a[i]!, -a[i + 1]!, -a[i + 2]!, a[i + 3]!, b, j);
}

function productInto(
  out: Float64Array,
  o: number,
  ax: number,
  ay: number,
  az: number,
  aw: number,
  b: Float64Array,
  j: number,
): void {
  const x = b[j]!;
  const y = b[j + 1]!;
  const z = b[j + 2]!;
  const w = b[j + 3]!;
  out[o] = aw * x + ax * w + ay * z - az * y;
  out[o + 1] = aw * y - ax * z + ay * w + az * x;
  out[o + 2] = aw * z + ax * y - ay * x + az * w;
  out[o + 3] = aw * w - ax * x - ay * y - az * z;
}

/** The vector v rotated by q. */
export function rotateInto(
  out: Float64Array,
  o: number,
  q: Float64Array,
  i: number,
  v: Float64Array,
  j: number,
): void {
  rotatedInto(out, o, q[i]!, q[i + 1]!, q[i + 2]!, q[i + 3]!, v, j);
}

/** The vector v rotated by the inverse of q. */
export function rotateInverseInto(
  out: Float64Array,
  o: number,
  q: Float64Array,
  i: number,
  v: Float64Array,
  j: number,
): void {
  rotatedInto(out, o, -q[i]!, -q[i + 1]!, -q[i + 2]!, q[i + 3]!, v, j);
}

function rotatedInto(
  out: Float64Array,
  o: number,
  qx: number,
  qy: number,
  qz: number,
  qw: number,
  v: Float64Array,
  j: number,
): void {
  const x = v[j]!;
  const y = v[j + 1]!;
  const z = v[j + 2]!;
  const tx = 2 * (qy * z - qz * y);
  const ty = 2 * (qz * x - qx * z);
  const tz = 2 * (qx * y - qy * x);
  out[o] = x + qw * tx + (qy * tz - qz * ty);
  out[o + 1] = y + qw * ty + (qz * tx - qx * tz);
  out[o + 2] = z + qw * tz + (qx * ty - qy * tx);
}

/** The rotation by `angle` radians about a unit vector. */
export function aboutAxisInto(
  out: Float64Array,
  o: number,
  axis: Float64Array,
  i: number,
  angle: number,
): void {
  const s = Math.sin(angle / 2);
  out[o] = axis[i]! * s;
  out[o + 1] = axis[i + 1]! * s;
  out[o + 2] = axis[i + 2]! * s;
  out[o + 3] = Math.cos(angle / 2);
}

/** The shortest rotation that brings the unit vector a onto the unit vector b: a swing without twist. */
export function betweenInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
): void {
  const cosine = dotAt(a, i, b, j);
  if (cosine < -0.999999) {
    anyPerpendicularInto(out, o, a, i);
    out[o + 3] = 0;
    return;
  }
  const x = a[i + 1]! * b[j + 2]! - a[i + 2]! * b[j + 1]!;
  const y = a[i + 2]! * b[j]! - a[i]! * b[j + 2]!;
  const z = a[i]! * b[j + 1]! - a[i + 1]! * b[j]!;
  normalisedInto(out, o, x, y, z, 1 + cosine);
}

/** The rotation whose matrix has as columns the unit vectors a and b, which are perpendicular, and their cross product. */
export function fromAxesInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
): void {
  const x0 = a[i]!;
  const x1 = a[i + 1]!;
  const x2 = a[i + 2]!;
  const y0 = b[j]!;
  const y1 = b[j + 1]!;
  const y2 = b[j + 2]!;
  const z0 = x1 * y2 - x2 * y1;
  const z1 = x2 * y0 - x0 * y2;
  const z2 = x0 * y1 - x1 * y0;
  if (x0 + y1 + z2 > 0) {
    normalisedInto(out, o, y2 - z1, z0 - x2, x1 - y0, 1 + x0 + y1 + z2);
  } else if (x0 > y1 && x0 > z2) {
    normalisedInto(out, o, 1 + x0 - y1 - z2, y0 + x1, z0 + x2, y2 - z1);
  } else if (y1 > z2) {
    normalisedInto(out, o, y0 + x1, 1 + y1 - x0 - z2, z1 + y2, z0 - x2);
  } else {
    normalisedInto(out, o, z0 + x2, z1 + y2, 1 + z2 - x0 - y1, x1 - y0);
  }
}

/** Spherical interpolation from a (t = 0) to b (t = 1) along the shorter arc (Shoemake 1985). */
export function slerpInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
  t: number,
): void {
  const dot = dotAt(a, i, b, j) + a[i + 3]! * b[j + 3]!;
  const angle = Math.acos(Math.min(1, Math.abs(dot)));
  // Nearly equal rotations: the sines below would be divided by a tiny number.
  const near = angle < 1e-4;
  const wa = near ? 1 - t : Math.sin((1 - t) * angle) / Math.sin(angle);
  const wb = (near ? t : Math.sin(t * angle) / Math.sin(angle)) * (dot < 0 ? -1 : 1);
  normalisedInto(
    out,
    o,
    a[i]! * wa + b[j]! * wb,
    a[i + 1]! * wa + b[j + 1]! * wb,
    a[i + 2]! * wa + b[j + 2]! * wb,
    a[i + 3]! * wa + b[j + 3]! * wb,
  );
}
