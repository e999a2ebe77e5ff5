/**
 * Vectors and unit quaternions as rows of flat arrays, for loops over thousands of frames; vec3.ts and quat.ts have
 * tuples. An operand is an array and the index of a row in it. The result is written to row `o` of `out`, which may be an
 * operand. Nothing is allocated.
 */
type Rows = Float64Array;

/** a + factor b. */
export function addScaled(
  out: Rows,
  o: number,
  a: Rows,
  i: number,
  b: Rows,
  j: number,
  factor: number,
): void {
  out[3 * o] = a[3 * i]! + factor * b[3 * j]!;
  out[3 * o + 1] = a[3 * i + 1]! + factor * b[3 * j + 1]!;
  out[3 * o + 2] = a[3 * i + 2]! + factor * b[3 * j + 2]!;
}

/** Unit vector from point a to point b, or the fallback where they are at one place. */
export function directionTo(
  out: Rows,
  o: number,
  a: Rows,
  i: number,
  b: Rows,
  j: number,
  fallback: Rows,
  k: number,
): void {
  const x = b[3 * j]! - a[3 * i]!;
  const y = b[3 * j + 1]! - a[3 * i + 1]!;
  const z = b[3 * j + 2]! - a[3 * i + 2]!;
  const size = Math.sqrt(x * x + y * y + z * z);
  if (size > 1e-9) {
    const factor = 1 / size;
    out[3 * o] = x * factor;
    out[3 * o + 1] = y * factor;
    out[3 * o + 2] = z * factor;
  } else {
    out[3 * o] = fallback[3 * k]!;
    out[3 * o + 1] = fallback[3 * k + 1]!;
    out[3 * o + 2] = fallback[3 * k + 2]!;
  }
}

/** The vector v rotated by q. */
export function rotateRow(out: Rows, o: number, q: Rows, i: number, v: Rows, j: number): void {
  const qx = q[4 * i]!;
  const qy = q[4 * i + 1]!;
  const qz = q[4 * i + 2]!;
  const qw = q[4 * i + 3]!;
  const x = v[3 * j]!;
  const y = v[3 * j + 1]!;
  const z = v[3 * j + 2]!;
  const tx = 2 * (qy * z - qz * y);
  const ty = 2 * (qz * x - qx * z);
  const tz = 2 * (qx * y - qy * x);
  out[3 * o] = x + qw * tx + (qy * tz - qz * ty);
  out[3 * o + 1] = y + qw * ty + (qz * tx - qx * tz);
  out[3 * o + 2] = z + qw * tz + (qx * ty - qy * tx);
}

/** The rotation b followed by a. */
export function multiplyRows(out: Rows, o: number, a: Rows, i: number, b: Rows, j: number): void {
  const ax = a[4 * i]!;
  const ay = a[4 * i + 1]!;
  const az = a[4 * i + 2]!;
  const aw = a[4 * i + 3]!;
  const bx = b[4 * j]!;
  const by = b[4 * j + 1]!;
  const bz = b[4 * j + 2]!;
  const bw = b[4 * j + 3]!;
  out[4 * o] = aw * bx + ax * bw + ay * bz - az * by;
  out[4 * o + 1] = aw * by - ax * bz + ay * bw + az * bx;
  out[4 * o + 2] = aw * bz + ax * by - ay * bx + az * bw;
  out[4 * o + 3] = aw * bw - ax * bx - ay * by - az * bz;
}

/** The inverse rotation. */
export function conjugateRow(out: Rows, o: number, q: Rows, i: number): void {
  out[4 * o] = -q[4 * i]!;
  out[4 * o + 1] = -q[4 * i + 1]!;
  out[4 * o + 2] = -q[4 * i + 2]!;
  out[4 * o + 3] = q[4 * i + 3]!;
}

/** Distance of two points. */
export function rowDistance(a: Rows | Float32Array, i: number, b: Rows | Float32Array, j: number): number {
  const x = a[3 * i]! - b[3 * j]!;
  const y = a[3 * i + 1]! - b[3 * j + 1]!;
  const z = a[3 * i + 2]! - b[3 * j + 2]!;
  return Math.sqrt(x * x + y * y + z * z);
}
