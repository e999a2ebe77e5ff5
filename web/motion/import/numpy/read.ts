import { sourceOfRotations } from './amass';
import { changesLengths } from './bone-lengths';
import { LANDMARK_COUNTS, landmarksIn } from './landmarks';
import { sourceOfPoints } from '../keypoints';
import { refuseTooLong } from '../../retarget/length';
import { bodyOf, JOINT_COUNTS, leaderFirst } from '../positions';
import { AppError } from '../../../common/error';
import { type DamageError, type NpzArray, openNpy, type StoredArray, unzipArrays } from '../../../common/npz';
import { ASSUMED_FPS, checkedRate } from '../../retarget/frame-rate';
import type { MotionSource } from '../../retarget/source';

/** Largest size of all arrays of an archive together, bytes. */
const MAX_BYTES = 256 * 1024 * 1024;
/** Names of the frame rate, of rotations and of the root's place, as research writes them. */
const RATES = ['mocap_framerate', 'mocap_frame_rate', 'fps', 'frame_rate', 'framerate'];
const ROTATIONS = ['poses', 'smpl_poses', 'full_pose', 'fullpose', 'pose', 'thetas', 'theta'];
/** Names of rotations of any part of a body: beside the root's place, arrays of such names hold no joints. */
const OF_ROTATIONS = /pose|theta|orient/i;
const PLACES = ['trans', 'smpl_trans', 'transl'];
/** Units of the root's place in a metre, in archives made of AIST++. */
const SCALING = 'smpl_scaling';
/** Smallest number of values of SMPL rotations: those of the body. */
const BODY_ROTATIONS = 66;

const damaged: DamageError = (message, cause) =>
  new AppError(
    'unreadable-file',
    message,
    'Save the arrays again with numpy.savez, as numbers without pickle.',
    {
      cause,
    },
  );

type Archive = ReadonlyMap<string, StoredArray>;

/**
 * The arrays of an archive without what is no array. Their values are read when they are needed: those of texts and
 * objects cannot be.
 */
function openArchive(bytes: Uint8Array): Archive {
  const arrays = new Map<string, StoredArray>();
  let failure: unknown = null;
  for (const [name, content] of unzipArrays(bytes, MAX_BYTES, damaged)) {
    try {
      arrays.set(name, openNpy(content, name.slice(0, 40), damaged));
    } catch (error) {
      failure ??= error;
    }
  }
  if (arrays.size === 0 && failure) throw failure as Error;
  return arrays;
}

/** Whether an array holds numbers, not truth values, texts or objects. */
const isOfNumbers = ({ type }: StoredArray): boolean => /^[<>|=]?[fiu]\d/.test(type);

/** The lengths of an array without a batch of one before them. */
const sizesOf = ({ shape }: StoredArray): readonly number[] =>
  shape.length > 2 && shape[0] === 1 ? shape.slice(1) : shape;

/** The first array of these names. */
const firstOf = (arrays: Archive, names: readonly string[]): StoredArray | null =>
  names.map((name) => arrays.get(name)).find((found) => found !== undefined) ?? null;

/** Numbers of joints by the values of each: points of a body in pictures may have a fourth, how sure they are. */
const COUNTS: ReadonlyMap<number, readonly number[]> = new Map([
  [3, [...JOINT_COUNTS, ...LANDMARK_COUNTS]],
  [4, LANDMARK_COUNTS],
]);

/** Sizes of an array of joints, (T, J, 3), (1, T, J, 3) or (T, 3 J), with 4 for 3 as well; null for another array. */
function jointShape(array: StoredArray): { frames: number; count: number; width: number } | null {
  const [frames = 0, second = 0, third, ...more] = sizesOf(array);
  if (more.length > 0) return null;
  for (const [width, counts] of COUNTS) {
    const count = third === undefined ? second / width : third === width ? second : 0;
    if (counts.includes(count)) return { frames, count, width };
  }
  return null;
}

/**
 * Frames and values of an array of rotation vectors, (T, 3 J) or, with the root's place beside it, (T, J, 3) or
 * (1, T, J, 3): without, these are joints. Null for another array.
 */
function rotationShape(array: StoredArray, hasPlaces: boolean): { frames: number; width: number } | null {
  const [frames = 0, second = 0, third, ...more] = sizesOf(array);
  const isByJoint = third === 3 && more.length === 0 && hasPlaces;
  const width = third === undefined ? second : isByJoint ? 3 * second : 0;
  return width >= BODY_ROTATIONS ? { frames, width } : null;
}

/**
 * The rotations of a body, (T, 66 or more): in one array, or in those of the root (T, 3) and of the other joints (T, 63).
 * Null where there are none.
 */
function rotationsIn(arrays: Archive): NpzArray | null {
  const whole = firstOf(arrays, ROTATIONS);
  const turns = whole && rotationShape(whole, firstOf(arrays, PLACES) !== null);
  if (whole && turns) {
    const { frames, width } = turns;
    refuseTooLong(frames, Math.min(width, BODY_ROTATIONS));
    return { shape: [frames, width], data: whole.read().data };
  }
  const [root, body] = [arrays.get('root_orient'), arrays.get('pose_body')];
  const frames = root?.shape[0] ?? 0;
  if (!root || !body || !isShape(root, frames, 3) || !isShape(body, frames, BODY_ROTATIONS - 3)) return null;
  refuseTooLong(frames, BODY_ROTATIONS);
  const data = new Float64Array(frames * BODY_ROTATIONS);
  const [first, others] = [root.read().data, body.read().data];
  for (let frame = 0; frame < frames; frame++) {
    data.set(first.subarray(3 * frame, 3 * frame + 3), frame * BODY_ROTATIONS);
    const from = frame * (BODY_ROTATIONS - 3);
    data.set(others.subarray(from, from + BODY_ROTATIONS - 3), frame * BODY_ROTATIONS + 3);
  }
  return { shape: [frames, BODY_ROTATIONS], data };
}

const isShape = ({ shape }: StoredArray, frames: number, width: number): boolean =>
  shape.length === 2 && shape[0] === frames && shape[1] === width;

/** Names of the arrays of joints, the leader's first. */
function dancersIn(arrays: Archive): string[] {
  const hasPlaces = firstOf(arrays, PLACES) !== null;
  const names = [...arrays]
    .filter(([name]) => !hasPlaces || !OF_ROTATIONS.test(name))
    .filter(([, array]) => isOfNumbers(array) && jointShape(array))
    .map(([name]) => name);
  return leaderFirst(names, (name) => name);
}

/** The frame rate that the archive states, or the usual one. */
function rateOf(arrays: Archive): Pick<MotionSource, 'frameRate' | 'rateAssumed'> {
  const stated = RATES.map((name) => numberIn(arrays.get(name))).find((rate) => rate !== null);
  return {
    frameRate: () => (stated === undefined ? ASSUMED_FPS : checkedRate(stated)),
    rateAssumed: stated === undefined,
  };
}

/** The only value of an array; null where there is none, or none that can be read. */
function numberIn(array: StoredArray | undefined): number | null {
  if (!array?.shape.every((length) => length === 1)) return null;
  try {
    return array.read().data[0] ?? null;
  } catch {
    return null;
  }
}

/** The body's place, (T, 3) in metres; null where the archive has none of every frame. */
function placesIn(arrays: Archive, frames: number): NpzArray | null {
  const trans = firstOf(arrays, PLACES);
  const [count, axes, ...more] = trans ? sizesOf(trans) : [];
  if (!trans || count !== frames || axes !== 3 || more.length > 0) return null;
  const scaling = numberIn(arrays.get(SCALING));
  const metres = scaling !== null && scaling > 0 ? 1 / scaling : 1;
  return { shape: [frames, 3], data: Float64Array.from(trans.read().data, (value) => value * metres) };
}

/**
 * Reads .npy and .npz files: joints (T, 22, 3), (T, 55, 3) and alike or flat, points of a body in pictures such as
 * (T, 33, 3) or (T, 33, 4), and rotations of SMPL bodies as AMASS has them.
 *
 * @param part number of the dancer in an archive with several arrays of joints
 * @throws {AppError} `unreadable-file`, `not-motion`, `too-long` or `too-few-frames`
 */
export function readNumpy(bytes: Uint8Array, name: string, part: number): MotionSource {
  const isArchive = bytes[0] === 0x50 && bytes[1] === 0x4b;
  const arrays = isArchive
    ? openArchive(bytes)
    : new Map([['joints', openNpy(bytes, name.slice(0, 40), damaged)]]);
  const poses = rotationsIn(arrays);
  if (poses) {
    const frames = poses.shape[0]!;
    const places = placesIn(arrays, frames);
    const source = sourceOfRotations(poses, places, rateOf(arrays));
    const left = places ? null : firstOf(arrays, PLACES);
    if (!left) return source;
    const warning = `The body's place is (${left.shape.join(', ')}) for ${frames} frames and was left out.`;
    return { ...source, warnings: [...source.warnings, warning] };
  }
  const dancers = dancersIn(arrays);
  const chosen = dancers[part] ?? dancers[0];
  const array = chosen === undefined ? undefined : arrays.get(chosen);
  if (chosen === undefined || !array) throw noJoints(arrays);
  const { frames, count, width } = jointShape(array)!;
  refuseTooLong(frames, count * width);
  const values = array.read({ gaps: true }).data.filter((_, i) => i % width < 3);
  const body = (bodyOf(values, count) ?? landmarksIn(values, count))!;
  const doubt = 'Bones change their lengths all the time: the values may be rotations, not places of joints.';
  return sourceOfPoints(body, {
    format: isArchive ? 'NPZ' : 'NPY',
    ...rateOf(arrays),
    unit: null,
    upAxis: null,
    parts: dancers.length > 1 ? dancers : [],
    part: dancers.indexOf(chosen),
    warnings: changesLengths(body) ? [doubt] : [],
  });
}

function noJoints(arrays: Archive): AppError {
  if (arrays.size > 0 && [...arrays.values()].every(({ type }) => /^\|?O/.test(type))) {
    return new AppError(
      'not-motion',
      'The file holds a pickled Python object, which is not read here.',
      'Load it in Python and save the arrays in it, such as poses and trans, with numpy.savez.',
    );
  }
  const seen = [...arrays]
    .slice(0, 6)
    .map(([name, { shape }]) => `${name.slice(0, 24)} (${shape.join(', ')})`);
  return new AppError(
    'not-motion',
    `No array in this file is a motion; it holds ${seen.join(', ') || 'none that can be read'}.`,
    'A motion is an array (T, 22, 3) or (T, 55, 3) of joints in the order of SMPL, (T, 17, 3) or (T, 33, 3) of points of COCO or MediaPipe, or poses and trans as AMASS has them.',
  );
}
