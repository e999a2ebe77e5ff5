import { findUnit, findUp, floorHeight } from './axes-and-units';
import { type Body, measureBody, nodesOfBody, retarget, withToes } from './retarget';
import { truncated } from './frames';
import { sampleNodes } from './sample';
import { type BvhFile, parseBvhText } from './text';
import type { MotionClip } from '../skeleton/clip';
import { OWN_CONVENTION } from './conventions';
import { AppError } from '../../common/error';
import { frameRate, checkedRate } from './frame-rate';
import { type JointMap, mapJoints, TRUNK_JOINTS } from './joint-map';
import { restFrames } from './t-pose';
import { checkPlausible } from '../skeleton/plausible';
import { J, JOINT_COUNT, type JointName, SMPL22 } from '../skeleton/skeleton';
import { median } from '../math/statistics';
import { add, distance, lerp, readVec, scale, type Vec3, ZERO } from '../math/vec3';

/** Frames per second of every clip past this reader. */
const FPS = 30;
/**
 * Median acceleration of the mean joint above which the frame rate is doubted, m/s^2: salsa has 1.5 to 3, leaps up to 6.
 */
const MAX_ACCELERATION = 5.5;
/** A file that `writeBvh` wrote has its floor at 0; only one moved by more than this is put there again, metres. */
const OWN_FLOOR_TOLERANCE = 0.1;

/** Import report of a motion file. */
export interface LeaderReport {
  /** Name of the skeleton convention that fits the joint names. */
  readonly convention: string;
  /** Name in the file of each joint; null where it was estimated. */
  readonly joints: Readonly<Record<JointName, string | null>>;
  /** Joints that were estimated. */
  readonly estimated: readonly JointName[];
  /** Those of them that were placed along the spine of the file: pelvis and spine. */
  readonly retargeted: readonly JointName[];
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
  /** Sentences about changes to the motion that are no problem. */
  readonly remarks: readonly string[];
}

/** A dancer from a file: 22 joints, 30 fps, metres, y up, floor at 0, the file's own body size. */
export interface LeaderFile {
  readonly clip: MotionClip;
  readonly report: LeaderReport;
}

/** Mean vector from the feet to the head over the clip, in the file's unit. */
function meanUpright(body: Body): Vec3 {
  let sum = ZERO;
  for (let frame = 0; frame < body.motion.frames; frame++) sum = add(sum, measureBody(body, frame).upright);
  return scale(sum, 1 / body.motion.frames);
}

/** Median over the clip of a value that `measureBody` gives. */
function medianOf(body: Body, value: (measured: ReturnType<typeof measureBody>) => number): number {
  return median(
    Float64Array.from({ length: body.motion.frames }, (_, frame) => value(measureBody(body, frame))),
  );
}

/** Median acceleration of the mean joint, m/s^2. */
function medianAcceleration(clip: MotionClip): number {
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

/** The positions in metres, shifted so that the floor is at y = 0. */
function shiftFloorToZero(positions: Float64Array, metres: number, own: boolean): Float32Array {
  const frames = positions.length / (JOINT_COUNT * 3);
  const lower = Float64Array.from({ length: frames }, (_, frame) => {
    const height = (joint: number): number => positions[(frame * JOINT_COUNT + joint) * 3 + 1]! * metres;
    return Math.min(height(J.left_foot), height(J.right_foot));
  });
  const floor = floorHeight(lower);
  const shift = own && Math.abs(floor) < OWN_FLOOR_TOLERANCE ? 0 : floor;
  return Float32Array.from(positions, (value, i) => value * metres - (i % 3 === 1 ? shift : 0));
}

/** The file's name of every joint; null where it was estimated. */
function sourceNames(file: BvhFile, map: JointMap, body: Body, estimated: readonly JointName[]) {
  const nodes = new Map<JointName, number>(map.nodes);
  if (body.toes.left !== null) nodes.set('left_foot', body.toes.left);
  if (body.toes.right !== null) nodes.set('right_foot', body.toes.right);
  return Object.fromEntries(
    SMPL22.map((name) => [name, estimated.includes(name) ? null : file.nodes[nodes.get(name)!]!.name]),
  ) as Record<JointName, string | null>;
}

/** The remark on `frames` left out at the beginning. */
function restPoseRemark(frames: number): string {
  const first = 'The first frame is a rest pose and is left out';
  if (frames === 1) return `${first}.`;
  const landing = frames === 2 ? 'the next one' : `the ${frames - 1} after it`;
  return `${first}, with ${landing}, in which the body jumps from it into the dance.`;
}

/**
 * Reads a dancer from the text of a BVH file.
 *
 * Joints are found by name, missing ones are estimated, a rest pose before the dance is left out, unit and up axis are
 * inferred from the body, the motion is resampled to 30 fps and its floor put at 0.
 *
 * @param options.fps frame rate to use instead of the file's own
 * @throws {AppError} if the file cannot be read, with a sentence and a hint
 */
export function readBvh(text: string, options: { readonly fps?: number } = {}): LeaderFile {
  const whole = parseBvhText(text);
  const map = mapJoints(whole.nodes);
  const rest = restFrames(whole, map);
  const file: BvhFile = { ...whole, frameLines: whole.frameLines.slice(rest) };
  const sourceFps = options.fps === undefined ? frameRate(file.frameTime) : checkedRate(options.fps);
  const motion = sampleNodes(file, nodesOfBody(file.nodes, map), sourceFps, FPS);
  if (motion.frames < 2) {
    const count = file.frameLines.length;
    if (file.truncated)
      throw truncated(`The file breaks off: only ${count} whole frames are there, too few for a dance.`);
    throw new AppError(
      'too-few-frames',
      `At ${sourceFps} frames per second the ${count} frames last less than two frames at ${FPS}.`,
      'Choose a longer dance, or correct the frame rate.',
    );
  }
  const asWritten = withToes(file.nodes, map, motion);
  const up = findUp(meanUpright(asWritten));
  const body: Body = { ...asWritten, up: up.turn };
  const size = medianOf(body, (measured) => measured.size);
  if (!(size > 0)) {
    throw new AppError(
      'not-a-body',
      'The joints of this file all lie in one place: its skeleton has no size.',
      'Export the file again with the offsets of the skeleton.',
    );
  }
  const unit = findUnit(size);
  const own = map.convention === OWN_CONVENTION;
  const { positions, estimated } = retarget(body);
  const clip: MotionClip = {
    fps: FPS,
    frames: motion.frames,
    positions: shiftFloorToZero(positions, unit.metres, own),
  };

  checkPlausible(clip);

  const warnings = [...file.warnings];
  if (!up.certain) warnings.push(`It is not clear which way is up; ${up.name} was taken.`);
  if (!unit.known) warnings.push('No unit gives this body the size of a person; it was scaled to one.');
  if (medianOf(body, (measured) => measured.footAhead) < -0.3) {
    warnings.push('The feet point backwards: left and right of this file may be exchanged.');
  }
  // The frame rate of a file that `writeBvh` wrote is right.
  if (!own && clip.frames > FPS && medianAcceleration(clip) > MAX_ACCELERATION) {
    warnings.push(
      `The dancer moves hastily for a person. If the dance looks hurried, the frame rate of the file (${Number(sourceFps.toFixed(2))}) is wrong: set half of it.`,
    );
  }
  const report: LeaderReport = {
    convention: map.convention,
    joints: sourceNames(file, map, body, estimated),
    estimated,
    retargeted: map.spine.length > 0 ? estimated.filter((name) => TRUNK_JOINTS.includes(name)) : [],
    sourceFps,
    sourceFrames: file.frameLines.length,
    sourceDuration: file.frameLines.length / sourceFps,
    unit: unit.name,
    upAxis: up.name,
    warnings,
    remarks: rest > 0 ? [restPoseRemark(rest)] : [],
  };
  return { clip, report };
}
