/**
 * Vectors inside flat arrays, for loops over thousands of frames; vec3.ts has tuples for single values. An operand is an
 * array and the index of its first number. A result is written to `out` from index `o` on, and `out` may be an operand.
 * Nothing is allocated.
 */

export function dotAt(a: Float64Array, i: number, b: Float64Array, j: number): number {
  return a[i]! * b[j]! + a[i + 1]! * b[j + 1]! + a[i + 2]! * b[j + 2]!;
}

export function lengthAt(a: Float64Array, i: number): number {
  return Math.sqrt(dotAt(a, i, a, i));
}

export function distanceAt(a: Float64Array, i: number, b: Float64Array, j: number): number {
  const x = a[i]! - b[j]!;
  const y = a[i + 1]! - b[j + 1]!;
  const z = a[i + 2]! - b[j + 2]!;
  return Math.sqrt(x * x + y * y + z * z);
}

export function copyInto(out: Float64Array, o: number, a: Float64Array, i: number): void {
  out[o] = a[i]!;
  out[o + 1] = a[i + 1]!;
  out[o + 2] = a[i + 2]!;
}

/** a + factor b. */
export function addInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
  factor = 1,
): void {
  out[o] = a[i]! + factor * b[j]!;
  out[o + 1] = a[i + 1]! + factor * b[j + 1]!;
  out[o + 2] = a[i + 2]! + factor * b[j + 2]!;
}

/** a - b. */
export function subtractInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
): void {
  out[o] = a[i]! - b[j]!;
  out[o + 1] = a[i + 1]! - b[j + 1]!;
  out[o + 2] = a[i + 2]! - b[j + 2]!;
}

export function crossInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  b: Float64Array,
  j: number,
): void {
  const x = a[i + 1]! * b[j + 2]! - a[i + 2]! * b[j + 1]!;
  const y = a[i + 2]! * b[j]! - a[i]! * b[j + 2]!;
  const z = a[i]! * b[j + 1]! - a[i + 1]! * b[j]!;
  out[o] = x;
  out[o + 1] = y;
  out[o + 2] = z;
}

/** Unit vector along a, or the fallback where a has no direction. */
export function directionInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  fallback: Float64Array,
  j: number,
): void {
  const size = lengthAt(a, i);
  if (size > 1e-9) {
    out[o] = a[i]! / size;
    out[o + 1] = a[i + 1]! / size;
    out[o + 2] = a[i + 2]! / size;
  } else copyInto(out, o, fallback, j);
}

/** Unit vector along the part of a that is perpendicular to a unit vector, or the fallback. */
export function perpendicularInto(
  out: Float64Array,
  o: number,
  a: Float64Array,
  i: number,
  axis: Float64Array,
  j: number,
  fallback: Float64Array,
  k: number,
): void {
  addInto(out, o, a, i, axis, j, -dotAt(a, i, axis, j));
  directionInto(out, o, out, o, fallback, k);
}

/** Coordinate axes as rows: x, y and z begin at 0, 3 and 6. */
export const AXES = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);

/** Any unit vector perpendicular to a unit vector; the two are not the same place. */
export function anyPerpendicularInto(out: Float64Array, o: number, axis: Float64Array, i: number): void {
  perpendicularInto(out, o, AXES, Math.abs(axis[i]!) < 0.6 ? 0 : 6, axis, i, AXES, 3);
}
