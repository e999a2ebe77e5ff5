import { readAscii } from './ascii';
import { readBinary } from './binary';
import { damagedFbx } from './node';
import { type Clip, type Curve, type FbxScene, type Model, sceneOf } from './scene';
import { placeWithin, rigOf, type Stretch, stretchOf } from './transform';
import { refuseTooLong } from '../../retarget/length';
import { AppError } from '../../../common/error';
import { writeQuat } from '../../math/quat';
import { type Vec3, writeVec } from '../../math/vec3';
import { pickDancer, pickFirstDancer } from '../../retarget/dancers';
import { ASSUMED_FPS, nearestRate } from '../../retarget/frame-rate';
import { ALL_UNITS, type AxisName } from '../../retarget/axes-and-units';
import type { LocalPoses, MotionSource } from '../../retarget/source';
import { keyBefore } from '../../math/key-before';

/** Ticks of FBX in a second. */
const TICKS = 46_186_158_000;
/** Frames per second of the time modes; 0 is one of its own. */
const TIME_MODES = [0, 120, 100, 60, 50, 48, 30, 30, 29.97, 29.97, 25, 24, 1000, 23.976, 0, 96, 72, 59.94];
/** Largest number of joints and other objects. */
const MAX_MODELS = 2000;

/** Models in an order in which parents come first; objects that no joint hangs on are left out. */
function orderedModels({ models, parents }: FbxScene): Model[] {
  if (models.size > MAX_MODELS)
    throw damagedFbx(`it has ${models.size} objects; up to ${MAX_MODELS} are read`);
  const order: Model[] = [];
  const state = new Map<string, 'visiting' | 'done'>();
  const visit = (id: string): void => {
    if (state.get(id) === 'done') return;
    if (state.get(id) === 'visiting') throw damagedFbx('its joints form a circle');
    state.set(id, 'visiting');
    const parent = parents.get(id);
    if (parent !== undefined) visit(parent);
    state.set(id, 'done');
    order.push(models.get(id)!);
  };
  for (const id of models.keys()) visit(id);
  const limbs = order.filter(({ type }) => type === 'LimbNode' || type === 'Root' || type === 'Limb');
  if (limbs.length === 0) return order;
  // Beside joints only what they hang on: a mesh may have the name of a joint.
  const kept = new Set<string>();
  for (const limb of limbs)
    for (let id: string | undefined = limb.id; id !== undefined && !kept.has(id); id = parents.get(id))
      kept.add(id);
  return order.filter(({ id }) => kept.has(id));
}

/** The value of a curve at a time in ticks, linear between its keys.  */
function valueAt({ times, values }: Curve, time: number): number {
  const last = times.length - 1;
  if (time <= times[0]!) return values[0]!;
  if (time >= times[last]!) return values[last]!;
  const key = keyBefore(times, time);
  const span = times[key + 1]! - times[key]!;
  const share = span > 0 ? (time - times[key]!) / span : 0;
  return values[key]! + (values[key + 1]! - values[key]!) * share;
}

interface Timing {
  readonly start: number;
  readonly frames: number;
  readonly fps: number;
}

/** Frame rates of video are this share of a whole one: 29.97 of 30. */
const VIDEO_RATE = 1000 / 1001;

/**
 * The frame rate of a curve from its usual step, so that frames lie on keys and no angle is read halfway in a leap from
 * 180 to -180 degrees; null where it is none of a recording.
 */
function rateOf({ times }: Curve): number | null {
  const steps = [...times.subarray(1)].map((time, key) => time - times[key]!).sort((a, b) => a - b);
  const measured = TICKS / (steps[steps.length >> 1] ?? 0);
  const whole = nearestRate(measured);
  if (whole === null || whole < 20) return null;
  const video = whole * VIDEO_RATE;
  return Math.abs(measured - video) < Math.abs(measured - whole) ? video : whole;
}

/** First and last key of a clip and its frame rate: that of its densest curve, else of the file's settings. */
function timingOf(clip: Clip, settings: FbxScene['settings']): Timing {
  let [start, end, step] = [Infinity, -Infinity, Infinity];
  let densest: Curve | null = null;
  for (const { curves } of clip.channels)
    for (const curve of curves) {
      const [first, last] = [curve?.times[0], curve?.times.at(-1)];
      if (!curve || first === undefined || last === undefined) continue;
      start = Math.min(start, first);
      end = Math.max(end, last);
      const mean = (last - first) / (curve.times.length - 1);
      if (curve.times.length > 2 && mean < step) [step, densest] = [mean, curve];
    }
  const mode = TIME_MODES[Number(settings.get('TimeMode')?.[0] ?? 0)] ?? 0;
  const custom = Number(settings.get('CustomFrameRate')?.[0] ?? 0);
  const stated = mode > 0 ? mode : custom > 0 ? custom : ASSUMED_FPS;
  const fps = (densest && rateOf(densest)) ?? Math.min(120, Math.max(24, stated));
  const frames = end > start ? Math.floor(((end - start) / TICKS) * fps + 1e-3) + 1 : 0;
  return { start, frames, fps };
}

/** Every animated value of every model in a clip. */
function animationOf(clip: Clip): Map<string, readonly (Curve | null)[]> {
  return new Map(clip.channels.map(({ model, property, curves }) => [`${model} ${property}`, curves]));
}

/**
 * Poses of all models at times in ticks. Rotations are those of the models; translations are such that every joint is
 * where its file has it, scales of all kinds included.
 */
function posesOf(
  scene: FbxScene,
  order: readonly Model[],
  clip: Clip | null,
  times: readonly number[],
): LocalPoses {
  const animated = clip ? animationOf(clip) : new Map<string, readonly (Curve | null)[]>();
  const rigs = order.map(rigOf);
  const places = new Map(order.map(({ id }, index) => [id, index]));
  const parents = order.map(({ id }) => places.get(scene.parents.get(id) ?? '') ?? -1);
  const out = {
    rotations: new Float32Array(times.length * order.length * 4),
    translations: new Float32Array(times.length * order.length * 3),
  };
  const value = (id: string, property: string, rest: Vec3, time: number): Vec3 => {
    const curves = animated.get(`${id} ${property}`);
    if (!curves) return rest;
    return rest.map((still, axis) => {
      const curve = curves[axis];
      return curve && curve.times.length > 0 ? valueAt(curve, time) : still;
    }) as unknown as Vec3;
  };
  times.forEach((time, frame) => {
    const stretches: Stretch[] = [];
    order.forEach(({ id }, index) => {
      const rig = rigs[index]!;
      const parent = parents[index]!;
      const above = parent < 0 ? null : stretches[parent]!;
      const size = value(id, 'Lcl Scaling', rig.scale, time);
      const { place, turn } = rig.local(
        value(id, 'Lcl Translation', rig.translation, time),
        value(id, 'Lcl Rotation', rig.rotation, time),
        size,
      );
      stretches.push(stretchOf(above, turn, size, rig.inheritance));
      writeQuat(out.rotations, frame * order.length + index, turn);
      writeVec(out.translations, frame * order.length + index, above ? placeWithin(above, place) : place);
    });
  });
  return out;
}

/** The up axis of the file's settings. */
function upOf({ settings }: FbxScene): AxisName | null {
  const axis = Number(settings.get('UpAxis')?.[0] ?? NaN);
  const sign = Number(settings.get('UpAxisSign')?.[0] ?? 1);
  const name = (['x', 'y', 'z'] as const)[axis];
  return name === undefined ? null : sign < 0 ? `-${name}` : name;
}

/**
 * Reads an FBX file, binary or text, version 7: the hierarchy of its objects and one of its clips. Meshes, materials and
 * pictures are left out; curves are linear between their keys.
 *
 * @param part number of the clip; of the dancer in a file with one clip and several dancers
 * @throws {AppError} `unreadable-file`, `no-motion`, `too-few-frames` or `too-long`
 */
export function readFbx(bytes: Uint8Array, part: number): MotionSource {
  const isBinary = bytes[0] === 0x4b && bytes[18] === 0x20;
  const scene = sceneOf(isBinary ? readBinary(bytes) : readAscii(new TextDecoder().decode(bytes)));
  const order = orderedModels(scene);
  // A pose of one key is no motion.
  const clips = scene.clips
    .map((clip) => ({ ...clip, ...timingOf(clip, scene.settings) }))
    .filter(({ frames }) => frames >= 2);
  const clip = clips[part] ?? clips[0];
  if (order.length === 0 || scene.clips.length === 0) {
    throw new AppError(
      'no-motion',
      order.length === 0 ? 'The FBX file holds no joints.' : 'The FBX file holds a body without animation.',
      'Export it again with its animation, as FBX 2013 or newer (version 7); Mixamo: “FBX Binary” with a dance.',
    );
  }
  if (!clip) {
    throw new AppError(
      'too-few-frames',
      'The animation in the FBX file has no length.',
      'Export the whole animation, not only its current frame.',
    );
  }
  const { start, frames, fps } = clip;
  refuseTooLong(frames, order.length * 6);
  const centimetres = Number(scene.settings.get('UnitScaleFactor')?.[0] ?? 1);
  const indices = new Map(order.map(({ id }, index) => [id, index]));
  const source: MotionSource = {
    format: 'FBX',
    joints: order.map(({ id, name }) => ({
      name,
      parent: indices.get(scene.parents.get(id) ?? '') ?? -1,
    })),
    rest: posesOf(scene, order, null, [0]),
    frames,
    frameRate: () => fps,
    rateAssumed: false,
    unit: {
      name:
        ALL_UNITS.find(({ metres }) => Math.abs(100 * metres - centimetres) < 1e-4 * centimetres)?.name ??
        `units of ${centimetres} cm`,
      metres: centimetres / 100,
    },
    upAxis: upOf(scene),
    parts: clips.length > 1 ? clips.map(({ name }) => name.slice(0, 80)) : [],
    part: clips.indexOf(clip),
    warnings: clip.warnings,
    truncated: false,
    localPoses: (wanted) =>
      posesOf(
        scene,
        order,
        clip,
        wanted.map((frame) => start + (frame / fps) * TICKS),
      ),
  };
  const moved = new Set(
    clip.channels
      .filter(({ curves }) => curves.some((curve) => curve && curve.times.length > 1))
      .map(({ model }) => model),
  );
  const moves = (joint: number): boolean => moved.has(order[joint]!.id);
  return clips.length > 1 ? pickFirstDancer(source, moves) : pickDancer(source, part, moves);
}
