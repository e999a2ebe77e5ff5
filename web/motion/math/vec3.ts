/** Vectors of three numbers as tuples: small, immutable and cheap to allocate in V8. */
export type Vec3 = readonly [number, number, number];

type Numbers = Float32Array | Float64Array;

export const ZERO: Vec3 = [0, 0, 0];
export const X_AXIS: Vec3 = [1, 0, 0];
export const Y_AXIS: Vec3 = [0, 1, 0];
export const Z_AXIS: Vec3 = [0, 0, 1];

/** The vector that begins at array[3 * index]. */
export function readVec(array: Numbers, index: number): Vec3 {
  const at = 3 * index;
  return [array[at]!, array[at + 1]!, array[at + 2]!];
}

export function writeVec(array: Numbers, index: number, v: Vec3): void {
  const at = 3 * index;
  array[at] = v[0];
  array[at + 1] = v[1];
  array[at + 2] = v[2];
}

export function add(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function sub(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scale(a: Vec3, factor: number): Vec3 {
  return [a[0] * factor, a[1] * factor, a[2] * factor];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Vec3): number {
  return Math.sqrt(dot(a, a));
}

export function distance(a: Vec3, b: Vec3): number {
  return length(sub(a, b));
}

/** Linear interpolation from a (t = 0) to b (t = 1). */
export function lerp(a: Vec3, b: Vec3, t: number): Vec3 {
  return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t];
}

/** Unit vector along `a`, or `fallback` where `a` has no direction. */
export function direction(a: Vec3, fallback: Vec3): Vec3 {
  const size = length(a);
  return size > 1e-9 ? scale(a, 1 / size) : fallback;
}

/** Unit vector along the part of `a` that is perpendicular to the unit vector `axis`. */
export function perpendicular(a: Vec3, axis: Vec3, fallback: Vec3): Vec3 {
  return direction(sub(a, scale(axis, dot(a, axis))), fallback);
}

/** Any unit vector perpendicular to the unit vector `axis`. */
export function anyPerpendicular(axis: Vec3): Vec3 {
  const helper = Math.abs(axis[0]) < 0.6 ? X_AXIS : Z_AXIS;
  return perpendicular(helper, axis, Y_AXIS);
}

/** 0 below `from`, 1 above `to`, between them the cubic 3t² - 2t³. */
export function smoothstep(from: number, to: number, value: number): number {
  const t = Math.min(1, Math.max(0, (value - from) / (to - from)));
  return t * t * (3 - 2 * t);
}
