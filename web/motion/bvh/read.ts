import { findUnit, findUp, floorHeight } from './axes-and-units';
import { assemble, type Body, measure, nodesOfBody, withToes } from './retarget';
import { cutOff } from './frames';
import { sampleNodes } from './sample';
import { type BvhFile, parseBvhText } from './text';
import type { MotionClip } from '../skeleton/clip';
import { OWN_DIALECT } from './conventions';
import { AppError } from '../../common/error';
import { frameRate, givenRate } from './frame-rate';
import { type JointMap, mapJoints, TRUNK_JOINTS } from './joint-map';
import { restFrames } from './t-pose';
import { J, JOINT_COUNT, type JointName, SMPL22 } from '../skeleton/skeleton';
import { median } from '../math/statistics';
import { add, distance, lerp, readVec, scale, type Vec3, ZERO } from '../math/vec3';

/** Frames per second of every clip past this reader. */
const FPS = 30;
/** Median acceleration of the body's middle, m/s^2, that few dancers reach: salsa has 1.5 to 3, leaps up to 6. */
const HURRIED = 5.5;
/** A file of ours lies on the floor already; only one that was moved by more than this is put there again, metres. */
const OWN_FLOOR_SLACK = 0.1;

/** What was understood of a motion file, for the person who chose it. */
export interface LeaderReport {
  /** Family of joint names. */
  readonly dialect: string;
  /** Name in the file of each joint; null where it was made by rule. */
  readonly joints: Readonly<Record<JointName, string | null>>;
  /** Joints that were made by rule. */
  readonly filled: readonly JointName[];
  /** Those of them that the file has too, cut into other pieces: the back, on which our pelvis and spine are placed. */
  readonly recut: readonly JointName[];
  /** Frame rate that was used: the file's, or the one given. */
  readonly sourceFps: number;
  /** Frames of the file that were used. */
  readonly sourceFrames: number;
  /** Seconds at `sourceFps`. */
  readonly sourceDuration: number;
  readonly unit: string;
  /** 'y' or 'z', rarely another axis with its sign. */
  readonly upAxis: string;
  /** Sentences about what may be wrong. */
  readonly warnings: readonly string[];
  /** Sentences about what was done to the motion and is right. */
  readonly remarks: readonly string[];
}

/** A dancer from a file: 22 joints, 30 fps, metres, y up, floor at 0, the file's own body size. */
export interface LeaderFile {
  readonly clip: MotionClip;
  readonly report: LeaderReport;
}

function meanUpright(body: Body): Vec3 {
  let sum = ZERO;
  for (let frame = 0; frame < body.motion.frames; frame++) sum = add(sum, measure(body, frame).upright);
  return scale(sum, 1 / body.motion.frames);
}

function overTime(body: Body, value: (measured: ReturnType<typeof measure>) => number): number {
  return median(Float64Array.from({ length: body.motion.frames }, (_, frame) => value(measure(body, frame))));
}

/** Median acceleration of the body's middle (mean of the joints), m/s^2. */
function liveliness(clip: MotionClip): number {
  const middles = Array.from({ length: clip.frames }, (_, frame) => {
    let sum = ZERO;
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      sum = add(sum, readVec(clip.positions, frame * JOINT_COUNT + joint));
    }
    return scale(sum, 1 / JOINT_COUNT);
  });
  const accelerations = middles.slice(2).map((after, frame) => {
    const before = middles[frame]!;
    return distance(lerp(before, after, 0.5), middles[frame + 1]!) * 2 * clip.fps * clip.fps;
  });
  return median(accelerations);
}

function lowerFloor(positions: Float64Array, metres: number, own: boolean): Float32Array {
  const frames = positions.length / (JOINT_COUNT * 3);
  const lower = Float64Array.from({ length: frames }, (_, frame) => {
    const height = (joint: number): number => positions[(frame * JOINT_COUNT + joint) * 3 + 1]! * metres;
    return Math.min(height(J.left_foot), height(J.right_foot));
  });
  const floor = floorHeight(lower);
  const shift = own && Math.abs(floor) < OWN_FLOOR_SLACK ? 0 : floor;
  return Float32Array.from(positions, (value, i) => value * metres - (i % 3 === 1 ? shift : 0));
}

function sourceNames(file: BvhFile, map: JointMap, body: Body, filled: readonly JointName[]) {
  const nodes = new Map<JointName, number>(map.nodes);
  if (body.toes.left !== null) nodes.set('left_foot', body.toes.left);
  if (body.toes.right !== null) nodes.set('right_foot', body.toes.right);
  return Object.fromEntries(
    SMPL22.map((name) => [name, filled.includes(name) ? null : file.nodes[nodes.get(name)!]!.name]),
  ) as Record<JointName, string | null>;
}

/** What is said of `frames` left out at the beginning. */
function restWords(frames: number): string {
  const first = 'The first frame is a rest pose and is left out';
  if (frames === 1) return `${first}.`;
  const landing = frames === 2 ? 'the next one' : `the ${frames - 1} after it`;
  return `${first}, with ${landing}, in which the body jumps from it into the dance.`;
}

/**
 * Reads a dancer from the text of a BVH file.
 *
 * Joints are found by name, missing ones are filled by rule, a rest pose before the dance is left out, unit and up axis
 * come from the body, the motion is resampled to 30 fps and its floor put at 0.
 *
 * @param options.fps frame rate to use instead of the file's own
 * @throws {AppError} a sentence and a hint for everything that can be wrong with the file
 */
export function readBvh(text: string, options: { readonly fps?: number } = {}): LeaderFile {
  const whole = parseBvhText(text);
  const map = mapJoints(whole.nodes);
  const rest = restFrames(whole, map);
  const file: BvhFile = { ...whole, frameLines: whole.frameLines.slice(rest) };
  const sourceFps = options.fps === undefined ? frameRate(file.frameTime) : givenRate(options.fps);
  const motion = sampleNodes(file, nodesOfBody(file.nodes, map), sourceFps, FPS);
  if (motion.frames < 2) {
    const count = file.frameLines.length;
    if (file.cutOff)
      throw cutOff(`The file breaks off: only ${count} whole frames are there, too few for a dance.`);
    throw new AppError(
      'too-few-frames',
      `At ${sourceFps} frames per second the ${count} frames last less than two frames at ${FPS}.`,
      'Choose a longer dance, or correct the frame rate.',
    );
  }
  const lying = withToes(file.nodes, map, motion);
  const up = findUp(meanUpright(lying));
  const body: Body = { ...lying, up: up.turn };
  const size = overTime(body, (measured) => measured.size);
  if (!(size > 0)) {
    throw new AppError(
      'not-a-body',
      'The joints of this file all lie in one place: its skeleton has no size.',
      'Export the file again with the offsets of the skeleton.',
    );
  }
  const unit = findUnit(size);
  const own = map.dialect === OWN_DIALECT;
  const { positions, filled } = assemble(body);
  const clip: MotionClip = {
    fps: FPS,
    frames: motion.frames,
    positions: lowerFloor(positions, unit.metres, own),
  };

  const warnings = [...file.warnings];
  if (!up.clear) warnings.push(`It is not clear which way is up; ${up.name} was taken.`);
  if (!unit.known) warnings.push('No unit gives this body the size of a person; it was scaled to one.');
  if (overTime(body, (measured) => measured.footAhead) < -0.3) {
    warnings.push('The feet point backwards: left and right of this file may be exchanged.');
  }
  // The frame rate of a file of ours is known to be right.
  if (!own && clip.frames > FPS && liveliness(clip) > HURRIED) {
    warnings.push(
      `The dancer moves hastily for a person. If the dance looks hurried, the frame rate of the file (${Number(sourceFps.toFixed(2))}) is wrong: set half of it.`,
    );
  }
  const report: LeaderReport = {
    dialect: map.dialect,
    joints: sourceNames(file, map, body, filled),
    filled,
    recut: map.back.length > 0 ? filled.filter((name) => TRUNK_JOINTS.includes(name)) : [],
    sourceFps,
    sourceFrames: file.frameLines.length,
    sourceDuration: file.frameLines.length / sourceFps,
    unit: unit.name,
    upAxis: up.name,
    warnings,
    remarks: rest > 0 ? [restWords(rest)] : [],
  };
  return { clip, report };
}
