/** From what was seen in the pictures to the dancer's motion in space. */
import { AppError } from '../../common/error';
import { lockFeet } from '../../motion/contact/foot-lock';
import { solve } from '../../motion/fit/ik';
import { gaussianFilter } from '../../motion/math/statistics';
import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { bodyHeight } from '../../motion/skeleton/scale';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { Observations } from '../observations';
import { LANDMARK_COUNT } from '../pose/landmarks';
import { placeInSpace, toCameraAxes } from './camera';
import { levelled } from './floor';
import { undoFlips } from './flips';
import { holdRoot } from './root-hold';
import { jointsOf } from './joints';
import { oneEuro } from './one-euro';
import { FPS, type Series, seriesOf } from './series';

/** What the visitor can correct. */
export interface WorldOptions {
  /** Height of the dancer, metres. */
  readonly height: number;
  /** Focal length, relative to the longer side of the pictures. */
  readonly focal: number;
  /** Part of the video, seconds; null is all of it. */
  readonly trim: { readonly start: number; readonly end: number } | null;
}

export interface Reconstruction {
  readonly motion: SolvedMotion;
  readonly series: Series;
  /** Frames in which a flip was undone. */
  readonly flipped: number;
}

/** Height of a person relative to the length of leg plus spine that `bodyHeight` measures. */
export const STATURE = 1.245;
/** Smoothing of the pose, metres. */
const POSE_FILTER = { minCutoff: 1.5, beta: 6 };
/** Deviation of the smoothing of the place, seconds: depth is the noisy axis. */
const PLACE_DEVIATION = 0.06;
const DEPTH_DEVIATION = 0.25;

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
  const { series, changed } = undoFlips(raw);
  const focal = options.focal * Math.max(series.width, series.height);
  const smooth = { ...series, world: oneEuro(series.world, 3 * LANDMARK_COUNT, FPS, POSE_FILTER) };
  const world = toTrueSize(toCameraAxes(smooth, focal), options.height);
  const place = smoothPlace(placeInSpace(series, world, focal));
  const joints = jointsOf(inSpace(world, place));
  const upright = levelled(joints, FPS).joints;
  const clip: MotionClip = { fps: FPS, frames: series.frames, positions: upright };
  const held = holdRoot(solve(clip));
  return { motion: lockFeet(held), series, flipped: changed };
}

/** The landmarks at the size of a dancer of this height, metres. */
function toTrueSize(world: Float64Array, height: number): Float64Array {
  const positions = jointsOf(world);
  const frames = positions.length / (3 * JOINT_COUNT);
  const factor = height / (STATURE * bodyHeight({ fps: FPS, frames, positions }));
  return world.map((value) => value * factor);
}

function smoothPlace(place: Float64Array): Float64Array {
  const frames = place.length / 3;
  const out = new Float64Array(place.length);
  for (let axis = 0; axis < 3; axis++) {
    // Depth is smoothed along the ray of sight: across it the body is seen where it is.
    const track = Float64Array.from({ length: frames }, (_, frame) => {
      const [value, depth] = [place[3 * frame + axis]!, place[3 * frame + 2]!];
      return axis === 2 ? depth : value / depth;
    });
    const smooth = gaussianFilter(track, (axis === 2 ? DEPTH_DEVIATION : PLACE_DEVIATION) * FPS);
    for (let frame = 0; frame < frames; frame++) out[3 * frame + axis] = smooth[frame]!;
  }
  for (let frame = 0; frame < frames; frame++) {
    out[3 * frame]! *= out[3 * frame + 2]!;
    out[3 * frame + 1]! *= out[3 * frame + 2]!;
  }
  return out;
}

/** The landmarks where the body is, y up, z towards the camera. */
function inSpace(world: Float64Array, place: Float64Array): Float64Array {
  return world.map((value, i) => {
    const axis = i % 3;
    const moved = value + place[3 * Math.floor(i / (3 * LANDMARK_COUNT)) + axis]!;
    return axis === 0 ? moved : -moved;
  });
}
