import { length, lerp, sub, type Vec3 } from '../../motion/math/vec3';
import { ellipsoid, limb, smoothUnion, type Field, type LimbShape, type Station } from './field';

/** Build of a dancer: roles differ in breadth, never in sex. */
export interface Build {
  /** Factor on every radius. */
  readonly width: number;
  /** Further factor on the waist. */
  readonly waist: number;
}

export const BUILDS = {
  leader: { width: 1.06, waist: 1 },
  reactor: { width: 0.95, waist: 0.93 },
} as const satisfies Record<string, Build>;

/** What a body is made from: its joints in the bind pose (metres) and its build. */
export interface BodyPlan {
  readonly at: readonly Vec3[];
  readonly build: Build;
}

/** 1 is the left half of the body (+x), -1 the right. */
export type Side = 1 | -1;

/** Skin weights of a point: joints and their shares. */
export type Weights = readonly (readonly [joint: number, share: number])[];

/** A solid that is added to the body. */
export interface Shape {
  readonly field: Field;
  /** Bounding spheres, for leaving it out far from it. */
  readonly bounds: readonly { readonly centre: Vec3; readonly radius: number }[];
  /** Width of the smooth union with the shapes before it, metres; may vary along it. */
  readonly blend: Field;
  /** Largest blend width. */
  readonly maxBlend: number;
}

/** One rounded solid with skin weights. */
export interface Part extends Shape {
  readonly weights: (x: number, y: number, z: number) => Weights;
}

/** A blend width that is the same everywhere, or one that varies up to `max`, metres. */
export type Blend = number | { readonly max: number; readonly at: Field };

const blendOf = (blend: Blend): Pick<Shape, 'blend' | 'maxBlend'> =>
  typeof blend === 'number'
    ? { blend: () => blend, maxBlend: blend }
    : { blend: blend.at, maxBlend: blend.max };

export const limbPart = (shape: LimbShape, blend: Blend, weights: Part['weights']): Part => ({
  field: limb(shape),
  bounds: [
    {
      centre: lerp(shape.from, shape.to, 0.5),
      radius:
        length(sub(shape.to, shape.from)) / 2 +
        Math.max(...shape.stations.map((s) => Math.max(s.wide, s.deep ?? 0) + Math.abs(s.shift ?? 0))),
    },
  ],
  ...blendOf(blend),
  weights,
});

export const ball = (centre: Vec3, radii: Vec3, blend: Blend, weights: Part['weights']): Part => ({
  field: ellipsoid(centre, radii),
  bounds: [{ centre, radius: Math.max(...radii) }],
  ...blendOf(blend),
  weights,
});

/** Radii at the breadth of a build. */
export const scaledToBuild = (build: Build, stations: readonly Station[]): Station[] =>
  scaledBy(build.width, stations);

/** Factor for heads and hands, which vary half as much as bodies. */
export const halfBuildScale = (build: Build): number => 1 + (build.width - 1) / 2;

export const scaledBy = (factor: number, stations: readonly Station[]): Station[] =>
  stations.map((s) => ({ ...s, wide: s.wide * factor, deep: (s.deep ?? s.wide) * factor }));

/** Distance from the middle plane from which on left and right of a pair do not blend, metres. */
const PAIR_BLEND_WIDTH = 0.14;

/**
 * Left and right as one shape: they blend with each other over `between` metres first and with the body together, so
 * that the order makes no difference and the body stays symmetric.
 */
export function pair(left: Shape, right: Shape, between: number): Shape {
  return {
    field: (x, y, z) =>
      x > PAIR_BLEND_WIDTH
        ? left.field(x, y, z)
        : x < -PAIR_BLEND_WIDTH
          ? right.field(x, y, z)
          : smoothUnion(left.field(x, y, z), right.field(x, y, z), between),
    bounds: [...left.bounds, ...right.bounds],
    blend: (x, y, z) => (x > 0 ? left : right).blend(x, y, z),
    maxBlend: Math.max(left.maxBlend, right.maxBlend),
  };
}

/** Shapes that can affect the surface within `radius` of a point. */
export function shapesNear<S extends Shape>(
  shapes: readonly S[],
  x: number,
  y: number,
  z: number,
  radius: number,
): S[] {
  const found: S[] = [];
  for (const shape of shapes)
    for (const bound of shape.bounds) {
      const dx = x - bound.centre[0];
      const dy = y - bound.centre[1];
      const dz = z - bound.centre[2];
      const within = bound.radius + shape.maxBlend + radius;
      if (dx * dx + dy * dy + dz * dz >= within * within) continue;
      found.push(shape);
      break;
    }
  return found;
}
