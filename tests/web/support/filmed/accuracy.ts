/** How near the motion from a video is to the motion that was filmed. */
import { gaussianFilter } from '../../../../web/motion/math/statistics';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { headingOf } from '../../../../web/motion/skeleton/heading';
import { bodyHeight } from '../../../../web/motion/skeleton/scale';
import { FEET, J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { reconstruct, STATURE } from '../../../../web/video/world/reconstruct';
import { motionOf } from './motions';
import { recorded } from './recording';
import type { FilmedMotion, Shot } from './shots';

export interface Accuracy {
  /** Mean distance of the joints with both pelvises in one place, metres. */
  readonly pose: number;
  /** Mean distance of the root over the floor after the means are aligned, metres. */
  readonly place: number;
  /** Distance that the root travels over the floor, smoothed: as it was, and as the motion from the video has it, metres. */
  readonly travelled: number;
  readonly found: number;
  /** Mean error of the heading, radians, and the share of the frames in which it is more than a right angle. */
  readonly heading: number;
  readonly flipped: number;
  /** Mean speed over the floor of ankles and toes that stand in truth, m/s. */
  readonly feet: number;
  /** How far a toe is under the floor at most, metres. */
  readonly sunk: number;
}

/** Speed below which a foot of the truth stands, and height of its toes above their lowest, m/s and metres. */
const STANDING_SPEED = 0.08;
const STANDING_HEIGHT = 0.03;
/** Deviation of the smoothing of paths before their length is taken, seconds. */
const PATH_DEVIATION = 0.25;
/** Root paths shorter than this a second are no distance to compare with, m/s. */
const ON_THE_SPOT = 0.1;

/** Whether the dancer goes anywhere, so that distances can be told as shares of the way. */
export function travels({ travelled }: Accuracy, { seconds }: FilmedMotion): boolean {
  return travelled > ON_THE_SPOT * seconds;
}

/** Reads the recording of a filmed motion and compares what becomes of it with the truth. */
export function accuracyOf(filmed: FilmedMotion): Accuracy {
  const truth = motionOf(filmed.motion);
  const { shot } = filmed;
  const { motion, series } = reconstruct(recorded(filmed.name), {
    height: STATURE * bodyHeight(truth),
    focal: shot.focal / Math.max(shot.width, shot.height),
    trim: null,
  });
  const first = Math.round(series.start * truth.fps);
  const frames = Math.min(motion.frames, truth.frames - first);
  const row = JOINT_COUNT * 3;
  const found = inWorld(motion, shot).subarray(0, frames * row);
  return compared(found, truth.positions.subarray(first * row, (first + frames) * row), truth.fps);
}

/** The motion turned from the camera's axes, whose -z is ahead, to those of the world. */
function inWorld({ positions }: SolvedMotion, { position, target }: Shot): Float32Array {
  const [x, z] = [target[0] - position[0], target[2] - position[2]];
  const size = Math.hypot(x, z);
  const [sin, cos] = [-x / size, -z / size];
  const out = positions.slice();
  for (let i = 0; i < out.length; i += 3) {
    out[i] = positions[i]! * cos + positions[i + 2]! * sin;
    out[i + 2] = -positions[i]! * sin + positions[i + 2]! * cos;
  }
  return out;
}

function compared(found: Float32Array, truth: Float32Array, fps: number): Accuracy {
  const row = JOINT_COUNT * 3;
  const frames = truth.length / row;
  const [path, known] = [rootPath(found), rootPath(truth)];
  let [pose, heading, flipped] = [0, 0, 0];
  for (let frame = 0; frame < frames; frame++) {
    const [a, b] = [found.subarray(frame * row), truth.subarray(frame * row)];
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const apart = (axis: number): number =>
        a[3 * joint + axis]! - a[3 * J.pelvis + axis]! - b[3 * joint + axis]! + b[3 * J.pelvis + axis]!;
      pose += Math.hypot(apart(0), apart(1), apart(2)) / (frames * JOINT_COUNT);
    }
    const turn = headingOf(a) - headingOf(b);
    const error = Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn)));
    heading += error / frames;
    flipped += Number(error > Math.PI / 2) / frames;
  }
  return {
    pose,
    place: meanDistance(path, known),
    travelled: pathLength(known, fps),
    found: pathLength(path, fps),
    heading,
    flipped,
    feet: standingSpeed(found, truth, fps),
    sunk: -lowestToe(found),
  };
}

function lowestToe(positions: Float32Array): number {
  let lowest = Infinity;
  for (let row = 0; row < positions.length; row += JOINT_COUNT * 3)
    for (const toe of [J.left_foot, J.right_foot]) lowest = Math.min(lowest, positions[row + 3 * toe + 1]!);
  return lowest;
}

interface Path {
  readonly x: Float64Array;
  readonly z: Float64Array;
}

function rootPath(positions: Float32Array): Path {
  const frames = positions.length / (JOINT_COUNT * 3);
  const column = (axis: number): Float64Array =>
    Float64Array.from(
      { length: frames },
      (_, frame) => positions[(frame * JOINT_COUNT + J.pelvis) * 3 + axis]!,
    );
  return { x: column(0), z: column(2) };
}

const mean = (values: Float64Array): number => values.reduce((sum, value) => sum + value, 0) / values.length;

function meanDistance(a: Path, b: Path): number {
  const [dx, dz] = [mean(a.x) - mean(b.x), mean(a.z) - mean(b.z)];
  return mean(a.x.map((x, t) => Math.hypot(x - b.x[t]! - dx, a.z[t]! - b.z[t]! - dz)));
}

function pathLength({ x, z }: Path, fps: number): number {
  const [sx, sz] = [gaussianFilter(x, PATH_DEVIATION * fps), gaussianFilter(z, PATH_DEVIATION * fps)];
  let sum = 0;
  for (let t = 1; t < sx.length; t++) sum += Math.hypot(sx[t]! - sx[t - 1]!, sz[t]! - sz[t - 1]!);
  return sum;
}

function standingSpeed(found: Float32Array, truth: Float32Array, fps: number): number {
  const row = JOINT_COUNT * 3;
  let [sum, count] = [0, 0];
  for (const joint of FEET) {
    let low = Infinity;
    for (let at = 3 * joint; at < truth.length; at += row) low = Math.min(low, truth[at + 1]!);
    for (let at = 3 * joint; at + row < truth.length; at += row) {
      const step = (positions: Float32Array): number =>
        fps *
        Math.hypot(positions[at + row]! - positions[at]!, positions[at + row + 2]! - positions[at + 2]!);
      if (step(truth) > STANDING_SPEED || truth[at + 1]! > low + STANDING_HEIGHT) continue;
      sum += step(found);
      count++;
    }
  }
  return sum / count;
}
