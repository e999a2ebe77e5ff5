import { TRUNK_JOINTS } from './joint-names';
import {
  ALL_UNITS,
  type AxisName,
  findUnit,
  findUp,
  floorHeight,
  isOfPerson,
  ownUnit,
  UP_AXES,
} from './axes-and-units';
import { type Body, measureBody, nodesOfBody, retarget, withToes } from './retarget';
import { sampleNodes, worldPose } from './sample';
import { type MotionSource, withoutFirst } from './source';
import { type ImportOptions, type RememberedJoints, skeletonFingerprint } from './options';
import { FPS, type MotionClip } from '../skeleton/clip';
import { OWN_CONVENTION } from '../bvh/names';
import { AppError } from '../../common/error';
import { checkedRate, nearestRate } from './frame-rate';
import { type JointMap, mapJoints, type MappedBy, withSidesExchanged } from './joint-map';
import { restFrames } from './t-pose';
import { checkPlausible } from '../skeleton/plausible';
import { J, JOINT_COUNT, type JointName, SMPL22 } from '../skeleton/skeleton';
import { median } from '../math/statistics';
import { aboutAxis, multiply } from '../math/quat';
import { add, distance, lerp, readVec, scale, sub, type Vec3, Y_AXIS, ZERO } from '../math/vec3';

/**
 * Median acceleration of the mean joint above which the frame rate is doubted, m/s^2: salsa has 1.5 to 3, leaps up to 6.
 */
const MAX_ACCELERATION = 5.5;
/** A file that `writeBvh` wrote has its floor at 0; only one moved by more than this is put there again, metres. */
const OWN_FLOOR_TOLERANCE = 0.1;

/**
 * Least share of the frames in which the dancer stands along the axis that the file or its rest pose has for up, whatever
 * the others are: a dancer may lie for most of a clip.
 */
const STANDING_SHARE = 0.1;

/** Import report of a motion file. */
export interface LeaderReport {
  /** Name of the format. */
  readonly format: string;
  /** Clips or dancers in the file, and the number of the one that was read. */
  readonly parts: readonly string[];
  readonly part: number;
  /** How the joints were found, and how certain that is, 0 to 1. */
  readonly mappedBy: MappedBy;
  readonly confidence: number;
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
  readonly unit: string;
  /** 'y' or 'z', rarely another axis with its sign. */
  readonly upAxis: AxisName;
  /** Height in the file of the floor that was put at 0, metres. */
  readonly floor: number;
  /** Half of `sourceFps`, where the dancer moves faster than people do and the rate is that of the file; else null. */
  readonly halfRate: number | null;
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

/** The axis that the file or its format states as up, or along which the body stands in the rest pose; null without one. */
function expectedUp(
  { joints, rest, upAxis }: MotionSource,
  { map: { nodes }, motion }: Body,
): AxisName | null {
  // Files of positions have no rest pose: in them no joint turns.
  const turns = [...nodes.values()].some((node) =>
    motion.rotation(node).some((value, i) => i % 4 < 3 && value),
  );
  if (upAxis || !turns) return upAxis;
  const { places } = worldPose(joints, rest, 0);
  const at = (name: JointName): Vec3 | undefined => places[nodes.get(name) ?? -1];
  const [top, left, right] = [at('head') ?? at('neck'), at('left_ankle'), at('right_ankle')];
  if (!top || !left || !right) return null;
  const found = findUp(sub(top, lerp(left, right, 0.5)));
  return found.certain ? found.name : null;
}

/**
 * The axis that points up in the mean over the clip, or the expected one where the dancer stands along it often enough.
 */
function bodyUp(body: Body, expected: AxisName | null): ReturnType<typeof findUp> {
  const { frames } = body.motion;
  const uprights = Array.from({ length: frames }, (_, frame) => measureBody(body, frame).upright);
  const along = uprights.map(findUp).filter(({ name, certain }) => certain && name === expected);
  if (along.length >= STANDING_SHARE * frames) return along[0]!;
  return findUp(scale(uprights.reduce(add, ZERO), 1 / frames));
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

/** Height of the floor in the file's positions, which are in metres. */
function findFloor(positions: Float32Array, own: boolean): number {
  const frames = positions.length / (JOINT_COUNT * 3);
  const lower = Float64Array.from({ length: frames }, (_, frame) => {
    const height = (joint: number): number => positions[(frame * JOINT_COUNT + joint) * 3 + 1]!;
    return Math.min(height(J.left_foot), height(J.right_foot));
  });
  const floor = floorHeight(lower);
  return own && Math.abs(floor) < OWN_FLOOR_TOLERANCE ? 0 : floor;
}

/** The positions in metres. */
const inMetres = (positions: Float64Array, metres: number): Float32Array =>
  Float32Array.from(positions, (value) => value * metres);

/** The file's name of every joint; null where it was estimated. */
function sourceNames(source: MotionSource, map: JointMap, body: Body, estimated: readonly JointName[]) {
  const nodes = new Map<JointName, number>(map.nodes);
  if (body.toes.left !== null) nodes.set('left_foot', body.toes.left);
  if (body.toes.right !== null) nodes.set('right_foot', body.toes.right);
  return Object.fromEntries(
    SMPL22.map((name) => [name, estimated.includes(name) ? null : source.joints[nodes.get(name)!]!.name]),
  ) as Record<JointName, string | null>;
}

/** The remark on `frames` left out at the beginning. */
function restPoseRemark(frames: number): string {
  const first = 'The first frame is a rest pose and is left out';
  if (frames === 1) return `${first}.`;
  const landing = frames === 2 ? 'the next one' : `the ${frames - 1} after it`;
  return `${first}, with ${landing}, in which the body jumps from it into the dance.`;
}

/** The remark on which of several clips or dancers was read, as nobody has chosen one. */
function partRemark({ parts, part }: MotionSource): string {
  return `The file holds ${parts.length} motions; “${parts[part]!}” was read. Another one can be chosen under “Joints and units”.`;
}

/** The body of a source with the axes that were found or set. */
function orientedBody(source: MotionSource, map: JointMap, fps: number, options: ImportOptions) {
  const motion = sampleNodes(source, nodesOfBody(source.joints, map), fps, FPS);
  if (motion.frames < 2) throw tooShort(source, fps);
  const asWritten = withToes(source.joints, map, motion);
  const found = bodyUp(asWritten, expectedUp(source, asWritten));
  const named = (name: AxisName | null | undefined) => UP_AXES.find((axis) => axis.name === name);
  const up = named(options.up) ?? (found.certain ? found : (named(source.upAxis) ?? found));
  const certain = options.up !== undefined || found.certain || source.upAxis !== null;
  const turn = aboutAxis(Y_AXIS, ((options.turn ?? 0) * Math.PI) / 180);
  const body: Body = { ...asWritten, up: multiply(turn, up.turn) };
  return { body, up: up.name, certain };
}

function tooShort({ frames, truncated }: MotionSource, fps: number): AppError {
  if (truncated)
    return new AppError(
      'truncated',
      `The file breaks off: only ${frames} whole frames are there, too few for a dance.`,
      'The file is incomplete: download, copy or export it again.',
    );
  return new AppError(
    'bad-frame-time',
    `At ${Number(fps.toFixed(2))} frames per second the ${frames} frames last less than two frames at ${FPS}.`,
    'Choose a longer dance, or correct the frame rate.',
  );
}

/** Whether this page wrote the file: its unit, floor and frame rate are then right. */
const isOwn = ({ convention }: JointMap): boolean => convention === OWN_CONVENTION;

/** The body's size in metres per unit of the file. */
function unitOf(source: MotionSource, body: Body, options: ImportOptions) {
  const size = medianOf(body, (measured) => measured.size);
  if (!(size > 0)) {
    throw new AppError(
      'not-a-body',
      'The joints of this file all lie in one place: its skeleton has no size.',
      'Export the file again with the offsets of the skeleton.',
    );
  }
  const chosen = ALL_UNITS.find(({ name }) => name === options.unit);
  const own = isOwn(body.map) ? ownUnit(size, source.unit) : null;
  if (!chosen) return { ...(own ? { ...own, known: true } : findUnit(size, source.unit)), doubt: null };
  const doubt = isOfPerson(size * chosen.metres) ? null : sizeDoubt(chosen.name, size * chosen.metres);
  return { ...chosen, known: true, doubt };
}

/** The warning about a body that a unit chosen by hand makes a dwarf or a giant. */
function sizeDoubt(unit: string, size: number): string {
  return `In ${unit} the dancer is ${size < 1 ? 'smaller' : 'larger'} than people are: ${size.toFixed(2)} m from the feet to the neck.`;
}

/** Mean of the cosines by which feet point backwards, from which on left and right are exchanged. */
const FEET_BACKWARDS = -0.3;

/** The body, y up; where its feet point backwards with left and right exchanged, and a warning. */
function facingBody(source: MotionSource, named: JointMap, fps: number, options: ImportOptions) {
  const found = orientedBody(source, named, fps, options);
  const feetAhead = medianOf(found.body, (measured) => measured.footAhead);
  if (!(feetAhead < FEET_BACKWARDS)) return { ...found, warnings: [] };
  if (named.by === 'hand') {
    const doubt = 'The feet point backwards: left and right of the chosen joints may be exchanged.';
    return { ...found, warnings: [doubt] };
  }
  return {
    ...orientedBody(source, withSidesExchanged(named), fps, options),
    warnings: ['The feet pointed backwards: left and right of this file were swapped, which is corrected.'],
  };
}

/** Whether the dancer moves faster than people do. */
function isHurried(clip: MotionClip): boolean {
  return clip.frames > FPS && medianAcceleration(clip) > MAX_ACCELERATION;
}

/**
 * Retargets the dancer of a motion file to the 22 joints.
 *
 * Joints are found by name or by the shape of the body, missing ones are estimated, exchanged sides are put right, a rest
 * pose before the dance is left out, unit and up axis are inferred from the body, the motion is resampled to 30 fps and
 * its floor put at 0.
 *
 * @param options what was set by hand
 * @param remembered joints that were chosen for skeletons of earlier files
 * @throws {AppError} if the motion is no dance, with a sentence and a hint
 */
export function leaderOf(
  whole: MotionSource,
  options: ImportOptions = {},
  remembered: RememberedJoints = {},
): LeaderFile {
  const skeleton = skeletonFingerprint(whole.joints.map(({ name }) => name));
  const choice = options.joints ?? remembered[skeleton];
  const named = mapJoints(whole.joints, worldPose(whole.joints, whole.rest, 0).places, choice);
  const rest = restFrames(whole, named);
  const source = withoutFirst(whole, rest);
  const fps = options.fps === undefined ? source.frameRate() : checkedRate(options.fps);
  const facing = facingBody(source, named, fps, options);
  const { body, up, certain } = facing;
  const warnings = [...source.warnings, ...facing.warnings];
  const { map } = body;
  const unit = unitOf(source, body, options);
  const own = isOwn(map);
  const { positions, estimated } = retarget(body);
  const placed = inMetres(positions, unit.metres);
  const floor = options.floor ?? findFloor(placed, own);
  const clip: MotionClip = {
    fps: FPS,
    frames: body.motion.frames,
    positions: placed.map((value, i) => (i % 3 === 1 ? value - floor : value)),
  };
  checkPlausible(clip);

  if (!certain) warnings.push(`It is not clear which way is up; ${up} was taken.`);
  if (!unit.known) warnings.push('No unit gives this body the size of a person; it was scaled to one.');
  if (unit.doubt) warnings.push(unit.doubt);
  // The frame rate of a file that `writeBvh` wrote is right.
  const hurried = !own && isHurried(clip);
  if (hurried)
    warnings.push(
      `The dancer moves faster than people do. If the dance looks hurried, the frame rate of the file (${Number(fps.toFixed(2))}) is wrong: set half of it.`,
    );
  warnings.push(...map.doubts);
  const remarks = rest > 0 ? [restPoseRemark(rest)] : [];
  if (source.rateAssumed && options.fps === undefined)
    remarks.push(`The file states no frame rate; ${Number(fps.toFixed(2))} was taken.`);
  if (source.parts.length > 1 && options.part === undefined) remarks.push(partRemark(source));
  const report: LeaderReport = {
    format: source.format,
    parts: source.parts,
    part: source.part,
    mappedBy: map.by,
    confidence: map.confidence,
    convention: source.convention ?? map.convention,
    joints: sourceNames(source, map, body, estimated),
    estimated,
    retargeted: map.spine.length > 0 ? estimated.filter((name) => TRUNK_JOINTS.includes(name)) : [],
    sourceFps: fps,
    unit: unit.name,
    upAxis: up,
    floor,
    halfRate: hurried && options.fps === undefined ? (nearestRate(fps / 2) ?? fps / 2) : null,
    warnings,
    remarks,
  };
  return { clip, report };
}
