import {
  ellipsoid,
  limb,
  length,
  meltUnion,
  mix,
  sub,
  unit,
  ramp,
  type Field,
  type LimbShape,
  type Station,
  type Vec3,
} from './field';

/** How a dancer is built: roles differ by breadth, never by sex. */
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

/** What a body is drawn after: its joints in the bind pose (metres) and its build. */
export interface Plan {
  readonly at: readonly Vec3[];
  readonly build: Build;
}

/** 1 is the left half of the body (+x), -1 the right. */
export type Side = 1 | -1;

/** Share of a joint in moving a point. */
export type Weights = readonly (readonly [joint: number, share: number])[];

/** Something that melts into the body or is cut out of it. */
export interface Shape {
  readonly field: Field;
  /** Balls that hold it, for skipping it. */
  readonly bounds: readonly { readonly centre: Vec3; readonly reach: number }[];
  /** Width over which it melts into what came before, metres; may vary along it. */
  readonly melt: Field;
  /** Largest melt. */
  readonly maxMelt: number;
  /** Cut out of the body instead of added to it. */
  readonly cut: boolean;
}

/** One rounded solid and the joints that carry it. */
export interface Part extends Shape {
  readonly weights: (x: number, y: number, z: number) => Weights;
}

/** A melt that is the same everywhere, or one that varies up to `most`. */
export type Melt = number | { readonly most: number; readonly at: Field };

const meltOf = (melt: Melt): Pick<Shape, 'melt' | 'maxMelt'> =>
  typeof melt === 'number' ? { melt: () => melt, maxMelt: melt } : { melt: melt.at, maxMelt: melt.most };

export const limbPart = (shape: LimbShape, melt: Melt, weights: Part['weights']): Part => ({
  field: limb(shape),
  bounds: [
    {
      centre: mix(shape.from, shape.to, 0.5),
      reach:
        length(sub(shape.to, shape.from)) / 2 +
        Math.max(...shape.stations.map((s) => Math.max(s.wide, s.deep ?? 0) + Math.abs(s.shift ?? 0))),
    },
  ],
  ...meltOf(melt),
  cut: false,
  weights,
});

export const ball = (centre: Vec3, radii: Vec3, melt: Melt, weights: Part['weights'], cut = false): Part => ({
  field: ellipsoid(centre, radii),
  bounds: [{ centre, reach: Math.max(...radii) }],
  ...meltOf(melt),
  cut,
  weights,
});

/** Radii at the breadth of a build. */
export const widened = (build: Build, stations: readonly Station[]): Station[] =>
  resized(build.width, stations);

/** Heads and hands vary less than bodies: half of the build's breadth. */
export const slightly = (build: Build): number => 1 + (build.width - 1) / 2;

export const resized = (factor: number, stations: readonly Station[]): Station[] =>
  stations.map((s) => ({ ...s, wide: s.wide * factor, deep: (s.deep ?? s.wide) * factor }));

/** Length of a bone and how far along it a point lies, metres. */
export function ruler(from: Vec3, to: Vec3): { span: number; down: Field } {
  const [ax, ay, az] = unit(sub(to, from));
  const start = from[0] * ax + from[1] * ay + from[2] * az;
  return { span: length(sub(to, from)), down: (x, y, z) => x * ax + y * ay + z * az - start };
}

export const carriedBy = (joint: number) => (): Weights => [[joint, 1]];

/** Shares that pass from joint `a` to joint `b` while `share` goes from 0 to 1. */
export const pass = (a: number, b: number, share: number): Weights =>
  share <= 0
    ? [[a, 1]]
    : share >= 1
      ? [[b, 1]]
      : [
          [a, 1 - share],
          [b, share],
        ];

/** Share of the bone behind a hinge such as a knee, `past` metres beyond it: half right at the joint. */
export const hinge = (past: number, width: number): number =>
  0.5 * ramp(-width, 0, past) + 0.5 * ramp(0, width, past);

/** Beyond this distance from the middle plane one half of a pair does not feel the other, metres. */
const MIDDLE = 0.14;

/**
 * Left and right as one shape: they melt into each other over `between` metres first and into the body together, so
 * that neither comes before the other and the body stays symmetric.
 */
export function pair(left: Shape, right: Shape, between: number): Shape {
  return {
    field: (x, y, z) =>
      x > MIDDLE
        ? left.field(x, y, z)
        : x < -MIDDLE
          ? right.field(x, y, z)
          : meltUnion(left.field(x, y, z), right.field(x, y, z), between),
    bounds: [...left.bounds, ...right.bounds],
    melt: (x, y, z) => (x > 0 ? left : right).melt(x, y, z),
    maxMelt: Math.max(left.maxMelt, right.maxMelt),
    cut: left.cut,
  };
}

/** Shapes that can matter within `radius` of a point. */
export function near<S extends Shape>(
  shapes: readonly S[],
  x: number,
  y: number,
  z: number,
  radius: number,
): S[] {
  const found: S[] = [];
  for (const shape of shapes)
    for (const { centre, reach } of shape.bounds) {
      const dx = x - centre[0];
      const dy = y - centre[1];
      const dz = z - centre[2];
      const within = reach + shape.maxMelt + radius;
      if (dx * dx + dy * dy + dz * dz >= within * within) continue;
      found.push(shape);
      break;
    }
  return found;
}
