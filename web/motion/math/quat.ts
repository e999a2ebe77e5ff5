import { anyPerpendicular, cross, dot, type Vec3 } from './vec3';

/** Unit quaternion xyzw; `multiply(a, b)` rotates first by b, then by a. */
export type Quat = readonly [number, number, number, number];

type Numbers = Float32Array | Float64Array;

export const IDENTITY: Quat = [0, 0, 0, 1];

/** The quaternion that begins at array[4 * index]. */
export function readQuat(array: Numbers, index: number): Quat {
  const at = 4 * index;
  return [array[at]!, array[at + 1]!, array[at + 2]!, array[at + 3]!];
}

export function writeQuat(array: Numbers, index: number, q: Quat): void {
  const at = 4 * index;
  array[at] = q[0];
  array[at + 1] = q[1];
  array[at + 2] = q[2];
  array[at + 3] = q[3];
}

export function multiply(a: Quat, b: Quat): Quat {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

/** The inverse rotation. */
export function conjugate(q: Quat): Quat {
  return [-q[0], -q[1], -q[2], q[3]];
}

/** The same rotation with all four signs changed. */
export function negate(q: Quat): Quat {
  return [-q[0], -q[1], -q[2], -q[3]];
}

export function quatDot(a: Quat, b: Quat): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

export function normaliseQuat(q: Quat): Quat {
  const size = Math.sqrt(quatDot(q, q));
  return size > 0 ? [q[0] / size, q[1] / size, q[2] / size, q[3] / size] : IDENTITY;
}

/** Angle of a rotation, radians. */
export function angleOf([x, y, z, w]: Quat): number {
  return 2 * Math.atan2(Math.hypot(x, y, z), Math.abs(w));
}

/** The mean of rotations that are near to each other, at least one. */
export function meanQuat(rotations: readonly Quat[]): Quat {
  const sum = [0, 0, 0, 0] as [number, number, number, number];
  for (const q of rotations) {
    const near = quatDot(q, rotations[0]!) < 0 ? negate(q) : q;
    near.forEach((value, i) => (sum[i]! += value));
  }
  return normaliseQuat(sum);
}

/** The vector v rotated by the unit quaternion q. */
export function rotate(q: Quat, v: Vec3): Vec3 {
  const x = 2 * (q[1] * v[2] - q[2] * v[1]);
  const y = 2 * (q[2] * v[0] - q[0] * v[2]);
  const z = 2 * (q[0] * v[1] - q[1] * v[0]);
  return [
    v[0] + q[3] * x + (q[1] * z - q[2] * y),
    v[1] + q[3] * y + (q[2] * x - q[0] * z),
    v[2] + q[3] * z + (q[0] * y - q[1] * x),
  ];
}

/** The rotation by `angle` radians about the unit vector `axis`. */
export function aboutAxis(axis: Vec3, angle: number): Quat {
  const s = Math.sin(angle / 2);
  return [axis[0] * s, axis[1] * s, axis[2] * s, Math.cos(angle / 2)];
}

/** The shortest rotation that brings the unit vector `from` onto the unit vector `to`: a swing without twist. */
export function between(from: Vec3, to: Vec3): Quat {
  const cosine = dot(from, to);
  if (cosine < -0.999999) return aboutAxis(anyPerpendicular(from), Math.PI);
  const axis = cross(from, to);
  return normaliseQuat([axis[0], axis[1], axis[2], 1 + cosine]);
}

/** The rotation whose matrix has as columns the given unit vectors; x and y are perpendicular, z is their cross product. */
export function fromAxes(x: Vec3, y: Vec3): Quat {
  const z = cross(x, y);
  const trace = x[0] + y[1] + z[2];
  if (trace > 0) {
    const s = 2 * Math.sqrt(1 + trace);
    return normaliseQuat([(y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s, s / 4]);
  }
  if (x[0] > y[1] && x[0] > z[2]) {
    const s = 2 * Math.sqrt(1 + x[0] - y[1] - z[2]);
    return normaliseQuat([s / 4, (y[0] + x[1]) / s, (z[0] + x[2]) / s, (y[2] - z[1]) / s]);
  }
  if (y[1] > z[2]) {
    const s = 2 * Math.sqrt(1 + y[1] - x[0] - z[2]);
    return normaliseQuat([(y[0] + x[1]) / s, s / 4, (z[1] + y[2]) / s, (z[0] - x[2]) / s]);
  }
  const s = 2 * Math.sqrt(1 + z[2] - x[0] - y[1]);
  return normaliseQuat([(z[0] + x[2]) / s, (z[1] + y[2]) / s, s / 4, (x[1] - y[0]) / s]);
}

/** Spherical interpolation from a (t = 0) to b (t = 1) along the shorter arc (Shoemake 1985). */
export function slerp(a: Quat, b: Quat, t: number): Quat {
  let cosine = quatDot(a, b);
  const end = cosine < 0 ? negate(b) : b;
  cosine = Math.min(1, Math.abs(cosine));
  const angle = Math.acos(cosine);
  // Nearly equal rotations: the sines below would be divided by a tiny number.
  const [wa, wb] =
    angle < 1e-4
      ? [1 - t, t]
      : [Math.sin((1 - t) * angle) / Math.sin(angle), Math.sin(t * angle) / Math.sin(angle)];
  return normaliseQuat([
    a[0] * wa + end[0] * wb,
    a[1] * wa + end[1] * wb,
    a[2] * wa + end[2] * wb,
    a[3] * wa + end[3] * wb,
  ]);
}
