import {
  add,
  cross,
  direction,
  dot,
  lerp,
  readVec,
  scale,
  sub,
  type Vec3,
  X_AXIS,
  ZERO,
} from '../../motion/math/vec3';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { L } from '../pose/landmark-names';
import type { DepthCues } from './depth';
import type { Series } from './series';
import { type Rays, raysOf } from './stance';

/** The floor in the axes of the camera: the direction up, and the camera's height above it in metres. */
export interface Ground {
  readonly up: Vec3;
  readonly height: number;
}

/** Up in the camera's axes, y down, when the camera is level. */
const LEVEL: Vec3 = [0, -1, 0];
/** Deviation of the place of a sole in the picture, as a share of the picture's shorter side. */
const SOLE_DEVIATION = 2.5 / 360;
/** Weight of the body's own upright against the floor: metres of spread over the floor at which both count the same. */
const BODY_SPREAD = 0.2;
/** How much lower than the other the foot is that carries the weight, metres. */
const FOOT_HEIGHT = 0.06;
/** Times that the standing foot and what is up are found, each from the other. */
const PASSES = 3;

/**
 * The floor from the soles that stand on it and from the body, which is upright on average. The farther the soles
 * spread, the more they count for what is level.
 * @param depth frames, of the hips
 */
export function groundOf({ series, world, stances, focal }: DepthCues, depth: Float64Array): Ground {
  const body = uprightOf(world, series.frames);
  const points = stances.flatMap(({ landmark, intervals }) => {
    const { x, y } = raysOf(series, landmark, focal);
    return intervals.flatMap(({ first, last }) =>
      Array.from({ length: last - first + 1 }, (_, i): Vec3 => {
        const t = first + i;
        const z = depth[t]! + world[3 * (t * LANDMARK_COUNT + landmark) + 2]!;
        return [x[t]! * z, y[t]! * z, z];
      }),
    );
  });
  const mean = scale(points.reduce(add, ZERO), 1 / Math.max(1, points.length));
  const up = planeNormal(points, mean, body);
  return { up, height: -dot(mean, up) };
}

/**
 * The mean direction from the standing foot to the middle of the trunk: who stands on one leg or leans keeps their weight
 * over that foot, and not in the middle of both.
 */
export function uprightOf(world: Float64Array, frames: number): Vec3 {
  let up = LEVEL;
  // Which foot is lower depends on what is up.
  for (let pass = 0; pass < PASSES; pass++) {
    let sum: Vec3 = ZERO;
    for (let frame = 0; frame < frames; frame++) {
      const at = (landmark: number): Vec3 => readVec(world, frame * LANDMARK_COUNT + landmark);
      const trunk = lerp(
        lerp(at(L.left_hip), at(L.right_hip), 0.5),
        lerp(at(L.left_shoulder), at(L.right_shoulder), 0.5),
        0.5,
      );
      const [left, right] = [at(L.left_ankle), at(L.right_ankle)];
      const rightStands = 1 / (1 + Math.exp((dot(right, up) - dot(left, up)) / FOOT_HEIGHT));
      sum = add(sum, direction(sub(trunk, lerp(left, right, rightStands)), up));
    }
    up = direction(sum, up);
  }
  return up;
}

/**
 * Normal of the plane through points, by least squares, drawn towards `guess` where they spread little: with axes a and
 * b square to the guess, heights h = p a + q b about the mean are fitted with a ridge on p and q.
 */
function planeNormal(points: readonly Vec3[], mean: Vec3, guess: Vec3): Vec3 {
  if (points.length < 3) return guess;
  const a = direction(sub(X_AXIS, scale(guess, dot(X_AXIS, guess))), X_AXIS);
  const b = cross(a, guess);
  const ridge = points.length * BODY_SPREAD * BODY_SPREAD;
  let [aa, ab, bb, ah, bh] = [ridge, 0, ridge, 0, 0];
  for (const point of points) {
    const d = sub(point, mean);
    const [x, y, h] = [dot(d, a), dot(d, b), dot(d, guess)];
    aa += x * x;
    ab += x * y;
    bb += y * y;
    ah += x * h;
    bh += y * h;
  }
  const determinant = aa * bb - ab * ab;
  const [p, q] = [(ah * bb - bh * ab) / determinant, (bh * aa - ah * ab) / determinant];
  return direction(sub(guess, add(scale(a, p), scale(b, q))), guess);
}

/** Where rays meet the floor, metres of depth, and the deviation of that; infinite where they do not. */
export function onFloor(
  { x, y }: Rays,
  { up, height }: Ground,
  picture: Pick<Series, 'width' | 'height'>,
  focal: number,
): { readonly depth: Float64Array; readonly deviation: Float64Array } {
  const pixels = SOLE_DEVIATION * Math.min(picture.width, picture.height);
  const depth = new Float64Array(x.length);
  const deviation = new Float64Array(x.length).fill(Infinity);
  for (let t = 0; t < x.length; t++) {
    const down = -(up[0] * x[t]! + up[1] * y[t]! + up[2]);
    if (down <= 1e-3 || height <= 0) continue;
    depth[t] = height / down;
    deviation[t] = (depth[t]! ** 2 * pixels) / (height * focal);
  }
  return { depth, deviation };
}
