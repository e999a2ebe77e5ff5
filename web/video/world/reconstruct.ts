/** From what was seen in the pictures to the dancer's motion in space. */
import { AppError } from '../../common/error';
import { liftFeet } from '../../motion/contact/floor-clearance';
import { solve } from '../../motion/fit/ik';
import { between, rotate } from '../../motion/math/quat';
import { gaussianFilter, median } from '../../motion/math/statistics';
import { cross, direction, dot, readVec, scale, sub, writeVec, X_AXIS } from '../../motion/math/vec3';
import { FPS, type MotionClip, type SolvedMotion } from '../../motion/skeleton/clip';
import { bodyHeight } from '../../motion/skeleton/scale';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { Observations } from '../observations';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { type Place, placeInSpace, toCameraAxes } from './camera';
import { depthOf } from './depth';
import { undoFlips } from './flips';
import { type Ground, groundOf, uprightOf } from './ground';
import { jointsOf } from './joints';
import { oneEuro } from './one-euro';
import { placeLegs } from './legs';
import { holdRoot } from './root-hold';
import { type Part, type Series, seriesOf } from './series';
import { stancesOf } from './stance';
import { asOfStillCamera } from './still-camera';

/** What the visitor can correct. */
export interface WorldOptions {
  /** Height of the dancer, metres. */
  readonly height: number;
  /** Focal length, relative to the longer side of the pictures. */
  readonly focal: number;
  /** Part of the video, seconds; null is all of it. */
  readonly trim: Part | null;
}

export interface Reconstruction {
  readonly motion: SolvedMotion;
  /** As it was seen. */
  readonly series: Series;
  /** Median depth of the dancer in front of the camera, metres. */
  readonly distance: number;
  /** Frames in which a flip was undone. */
  readonly flipped: number;
}

/** Height of a person relative to the length of leg plus spine that `bodyHeight` measures. */
export const STATURE = 1.245;
/** Smoothing of the pose, metres. */
const POSE_FILTER = { minCutoff: 1.5, beta: 6 };
/** Deviation of the smoothing of the place across, seconds. */
const PLACE_DEVIATION = 0.06;

/**
 * The motion of the dancer who was seen, on a skeleton of constant bones.
 * @throws {AppError} `video-too-short` when the person is in fewer than two pictures of the part that was asked for
 */
export function reconstruct(observations: Observations, options: WorldOptions): Reconstruction {
  const raw = seriesOf(observations, options.trim);
  if (!raw)
    throw new AppError(
      'video-too-short',
      'The dancer is not seen in this part of the video.',
      'Choose a longer part, or another one.',
    );
  const focal = options.focal * Math.max(raw.width, raw.height);
  const { series, changed } = undoFlips(asOfStillCamera(raw, focal));
  const smooth = { ...series, world: oneEuro(series.world, 3 * LANDMARK_COUNT, FPS, POSE_FILTER) };
  const tilted = toTrueSize(toCameraAxes(smooth, focal), options.height);
  const first = findGround(series, tilted, focal);
  // The body is upright on the floor on average; networks see the tilt of a camera too small.
  const turn = between(uprightOf(tilted, series.frames), first.ground.up);
  const world = new Float64Array(tilted.length);
  for (let i = 0; i < tilted.length / 3; i++) writeVec(world, i, rotate(turn, readVec(tilted, i)));
  const { ground, depth, place, cues } = findGround(series, world, focal);
  const landmarks = inSpace(world, acrossAt(place, depth));
  placeLegs(landmarks, cues, ground);
  const positions = jointsOf(upright(landmarks, ground));
  const clip: MotionClip = { fps: FPS, frames: series.frames, positions };
  const motion = liftFeet(holdRoot(solve(clip), cues.stances), 0);
  return { motion, series: raw, distance: median(depth), flipped: changed };
}

/** Stances, depth and floor. */
function findGround(series: Series, world: Float64Array, focal: number) {
  const place = placeInSpace(series, world, focal);
  const depth = depthOf(place.size);
  const cues = { series, world, stances: stancesOf(series, depth, focal), focal };
  return { place, depth, cues, ground: groundOf(cues, depth) };
}

/** The landmarks at the size of a dancer of this height, metres. */
function toTrueSize(world: Float64Array, height: number): Float64Array {
  const positions = jointsOf(world);
  const frames = positions.length / (3 * JOINT_COUNT);
  const factor = height / (STATURE * bodyHeight({ fps: FPS, frames, positions }));
  return world.map((value) => value * factor);
}

/** The place at these depths, frames x 3, metres in the camera's axes. */
function acrossAt({ offset, slope }: Place, depth: Float64Array): Float64Array {
  const out = new Float64Array(3 * depth.length);
  for (const axis of [0, 1]) {
    const across = gaussianFilter(
      depth.map((z, t) => (offset[2 * t + axis]! + slope[2 * t + axis]! * z) / z),
      PLACE_DEVIATION * FPS,
    );
    across.forEach((ratio, t) => (out[3 * t + axis] = ratio * depth[t]!));
  }
  depth.forEach((z, t) => (out[3 * t + 2] = z));
  return out;
}

/** The landmarks in the camera's axes, at the place of the body. */
function inSpace(world: Float64Array, place: Float64Array): Float64Array {
  return world.map((value, i) => value + place[3 * Math.floor(i / (3 * LANDMARK_COUNT)) + (i % 3)]!);
}

/** The landmarks y up and z towards the camera, with the floor level at height 0, without a turn about the vertical. */
function upright(landmarks: Float64Array, { up, height }: Ground): Float64Array {
  const x = direction(sub(X_AXIS, scale(up, dot(X_AXIS, up))), X_AXIS);
  const z = cross(x, up);
  const out = new Float64Array(landmarks.length);
  for (let i = 0; i < landmarks.length / 3; i++) {
    const v = readVec(landmarks, i);
    writeVec(out, i, [dot(v, x), dot(v, up) + height, dot(v, z)]);
  }
  return out;
}
