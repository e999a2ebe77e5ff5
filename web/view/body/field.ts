/**
 * Signed distance fields: the rounded solids that a body is made of, and their smooth union.
 * Distances are in metres, negative inside. Solids with elliptic sections give a bound that is exact at the surface
 * and of the right order around it, which is what the mesher needs.
 */
import { cross, direction, length, sub, type Vec3 } from '../../motion/math/vec3';

/** Distance from a point to a surface. */
export type Field = (x: number, y: number, z: number) => number;

/** One station along a limb: where it is, how thick, and how far its centre is moved. */
export interface Station {
  /** 0 at the start of the limb, 1 at its end. */
  readonly at: number;
  /** Radius across the limb (along `across`), metres. */
  readonly wide: number;
  /** Radius along the third axis, metres; the same as `wide` when left out. */
  readonly deep?: number;
  /** Centre moved along the third axis, metres. */
  readonly shift?: number;
}

/** Unit vector along `a`; of no length where `a` has none. */
export const unit = (a: Vec3): Vec3 => direction(a, a);

const clamp01 = (t: number): number => (t < 0 ? 0 : t > 1 ? 1 : t);

/** Smooth union of two distances over the width `k` (polynomial smooth minimum, Quilez 2013). */
export function smoothUnion(a: number, b: number, k: number): number {
  const h = k - Math.abs(a - b);
  return h <= 0 ? Math.min(a, b) : Math.min(a, b) - (h * h) / (4 * k);
}

/** Smooth difference: `a` without `b`, with an edge rounded over `k`. */
export function smoothCut(a: number, b: number, k: number): number {
  return -smoothUnion(-a, b, k);
}

/** Distance bound of an ellipsoid whose axes are the coordinate axes. */
export function ellipsoid(centre: Vec3, radii: Vec3): Field {
  const [cx, cy, cz] = centre;
  const [ix, iy, iz] = [1 / radii[0], 1 / radii[1], 1 / radii[2]];
  const thin = Math.min(...radii);
  return (x, y, z) => {
    const ux = (x - cx) * ix;
    const uy = (y - cy) * iy;
    const uz = (z - cz) * iz;
    const k0 = Math.sqrt(ux * ux + uy * uy + uz * uz);
    const k1 = Math.sqrt(ux * ux * ix * ix + uy * uy * iy * iy + uz * uz * iz * iz);
    return k1 < 1e-9 ? -thin : (k0 * (k0 - 1)) / k1;
  };
}

/** Intervals of the table of a profile. */
const SAMPLES = 64;

/** Monotone cubic interpolation of a value through two stations or more (Fritsch and Butland 1984), sampled to a table. */
function profile(stations: readonly Station[], value: (station: Station) => number): Float32Array {
  const table = new Float32Array(SAMPLES + 1);
  const n = stations.length;
  const xs = stations.map((station) => station.at);
  const ys = stations.map(value);
  const slopeFrom = (i: number): number => (ys[i + 1]! - ys[i]!) / (xs[i + 1]! - xs[i]!);
  const slopes = ys.map((_, i) => {
    if (i === 0) return slopeFrom(0);
    const left = slopeFrom(i - 1);
    if (i === n - 1) return left;
    const right = slopeFrom(i);
    return left * right <= 0 ? 0 : (2 * left * right) / (left + right);
  });
  let i = 0;
  for (let s = 0; s <= SAMPLES; s++) {
    const at = s / SAMPLES;
    while (i < n - 2 && at > xs[i + 1]!) i++;
    const width = xs[i + 1]! - xs[i]!;
    const t = clamp01((at - xs[i]!) / width);
    const t2 = t * t;
    const t3 = t2 * t;
    table[s] =
      ys[i]! * (2 * t3 - 3 * t2 + 1) +
      slopes[i]! * width * (t3 - 2 * t2 + t) +
      ys[i + 1]! * (3 * t2 - 2 * t3) +
      slopes[i + 1]! * width * (t3 - t2);
  }
  return table;
}

export interface LimbShape {
  readonly from: Vec3;
  readonly to: Vec3;
  /** Direction of `wide`; the third axis is the limb's direction x across. */
  readonly across: Vec3;
  readonly stations: readonly Station[];
  /** Exponent of the superellipse of a section: 2 gives ellipses, more gives squarer sections. */
  readonly exponent?: number;
}

/** A limb along a straight bone, with rounded ends and sections that change along it. */
export function limb(shape: LimbShape): Field {
  const { from, to, stations, exponent = 2 } = shape;
  const span = length(sub(to, from));
  const along = unit(sub(to, from));
  const third = unit(cross(along, shape.across));
  // Plain numbers in the closure: this runs a million times a body.
  const [fx, fy, fz] = from;
  const [ax, ay, az] = along;
  const [dx, dy, dz] = third;
  const [wx, wy, wz] = cross(third, along);
  const wide = profile(stations, (s) => s.wide);
  const deep = profile(stations, (s) => s.deep ?? s.wide);
  const shift = profile(stations, (s) => s.shift ?? 0);
  return (x, y, z) => {
    const px = x - fx;
    const py = y - fy;
    const pz = z - fz;
    const u = px * ax + py * ay + pz * az;
    const t = u <= 0 ? 0 : u >= span ? 1 : u / span;
    const over = u - t * span;
    const i = t === 1 ? SAMPLES - 1 : Math.floor(t * SAMPLES);
    const f = t * SAMPLES - i;
    const rw = wide[i]! + (wide[i + 1]! - wide[i]!) * f;
    const rd = deep[i]! + (deep[i + 1]! - deep[i]!) * f;
    const centre = shift[i]! + (shift[i + 1]! - shift[i]!) * f;
    const cap = rw < rd ? rw : rd;
    const v = Math.abs(px * wx + py * wy + pz * wz) / rw;
    const w = Math.abs(px * dx + py * dy + pz * dz - centre) / rd;
    const end = (over * over) / (cap * cap);
    const flat =
      exponent === 2 ? v * v + w * w : Math.pow(Math.pow(v, exponent) + Math.pow(w, exponent), 2 / exponent);
    const k0 = Math.sqrt(flat + end);
    const k1 = Math.sqrt((v * v) / (rw * rw) + (w * w) / (rd * rd) + end / (cap * cap));
    return k1 < 1e-9 ? -cap : (k0 * (k0 - 1)) / k1;
  };
}
