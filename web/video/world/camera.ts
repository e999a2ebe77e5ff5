import { aboutAxis, multiply, type Quat, rotate } from '../../motion/math/quat';
import { readVec, writeVec, X_AXIS, Y_AXIS } from '../../motion/math/vec3';
import { LANDMARK_COUNT } from '../pose/landmarks';
import type { Series } from './series';

/** Focal length of a phone's main camera, relative to the longer side of its pictures. */
export const DEFAULT_FOCAL = 0.9;
/** Landmarks that place the body: those of trunk and legs move least against each other. */
const PLACING: readonly number[] = [11, 12, 23, 24, 25, 26, 27, 28];
/** Depths that a dancer in full view can have, metres: what is nearer or farther was seen wrong. */
const MIN_DEPTH = 0.3;
const MAX_DEPTH = 60;
/** Visibility below which a landmark does not count. */
const MIN_VISIBILITY = 0.3;

/**
 * From the axes of what the network saw, which looks straight at a point of the picture, to those of the camera.
 * @param x, y of the point, pixels
 * @param focal pixels
 */
export function lookingAt(
  x: number,
  y: number,
  { width, height }: Pick<Series, 'width' | 'height'>,
  focal: number,
): Quat {
  const [right, down] = [(x - width / 2) / focal, (y - height / 2) / focal];
  const [yaw, pitch] = [Math.atan(right), Math.atan2(down, Math.hypot(1, right))];
  return multiply(aboutAxis(Y_AXIS, yaw), aboutAxis(X_AXIS, -pitch));
}

/**
 * Turns the landmarks from the axes of what the network saw, which looks straight at the person, to those of the
 * camera, which looks past them.
 * @param focal focal length, pixels
 * @returns frames x 33 x 3, metres
 */
export function toCameraAxes(series: Series, focal: number): Float64Array {
  const { world, centre, frames } = series;
  const out = new Float64Array(world.length);
  for (let frame = 0; frame < frames; frame++) {
    const turn = lookingAt(centre[2 * frame]!, centre[2 * frame + 1]!, series, focal);
    for (let i = frame * LANDMARK_COUNT; i < (frame + 1) * LANDMARK_COUNT; i++)
      writeVec(out, i, rotate(turn, readVec(world, i)));
  }
  return out;
}

/** Where the middle of the hips is in each frame, in the camera's axes, as far as one frame tells. */
export interface Place {
  /** Depth that the size of the body tells, metres. */
  readonly size: Float64Array;
  /** Place across for any depth z, x and y of a frame: `offset` + z x `slope`. */
  readonly offset: Float64Array;
  readonly slope: Float64Array;
}

/**
 * The translation t that brings the landmarks X nearest to their pictures (u, v) by linear least squares,
 * u (Z + t_z) = f (X + t_x) and the same for v.
 * @param world frames x 33 x 3 in the camera's axes, metres at the body's true size
 * @param focal pixels
 */
export function placeInSpace(
  { image, visibility, frames, width, height }: Series,
  world: Float64Array,
  focal: number,
): Place {
  const size = new Float64Array(frames);
  const offset = new Float64Array(frames * 2);
  const slope = new Float64Array(frames * 2);
  for (let frame = 0; frame < frames; frame++) {
    // Normal equations of f t_x - u t_z = u Z - f X and f t_y - v t_z = v Z - f Y, of which f is divided out.
    let [n, su, sv, suv, bx, by, bz] = [0, 0, 0, 0, 0, 0, 0];
    for (const landmark of PLACING) {
      const i = frame * LANDMARK_COUNT + landmark;
      const weight = Math.max(0.01, visibility[i]! - MIN_VISIBILITY);
      const u = (image[2 * i]! - width / 2) / focal;
      const v = (image[2 * i + 1]! - height / 2) / focal;
      const [x, y, z] = [world[3 * i]!, world[3 * i + 1]!, world[3 * i + 2]!];
      const [p, q] = [u * z - x, v * z - y];
      n += weight;
      su += weight * u;
      sv += weight * v;
      suv += weight * (u * u + v * v);
      bx += weight * p;
      by += weight * q;
      bz -= weight * (u * p + v * q);
    }
    // t_x = (bx + su t_z) / n and t_y = (by + sv t_z) / n leave one equation for t_z.
    const pivot = suv - (su * su + sv * sv) / n;
    const z = (bz + (su * bx + sv * by) / n) / Math.max(pivot, 1e-9);
    size[frame] = Math.min(MAX_DEPTH, Math.max(MIN_DEPTH, z));
    offset.set([bx / n, by / n], 2 * frame);
    slope.set([su / n, sv / n], 2 * frame);
  }
  return { size, offset, slope };
}
