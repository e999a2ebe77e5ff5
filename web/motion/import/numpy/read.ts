import { sourceOfRotations } from './amass';
import { bodyOf, JOINT_COUNTS, sourceOfPositions, tooLong } from '../positions';
import { AppError } from '../../../common/error';
import { type DamageError, type NpzArray, readNpy, unzipArrays } from '../../../common/npz';
import { ASSUMED_FPS, checkedRate } from '../../retarget/frame-rate';
import type { MotionSource } from '../../retarget/source';

/** Largest size of all arrays of an archive together, bytes. */
const MAX_BYTES = 256 * 1024 * 1024;
/** Frames per second where the file has none. */
/** Names of the frame rate, of rotations and of the root's place, as research writes them. */
const RATES = ['mocap_framerate', 'mocap_frame_rate', 'fps', 'frame_rate', 'framerate'];
const ROTATIONS = ['poses', 'smpl_poses', 'full_pose', 'fullpose'];
const PLACES = ['trans', 'smpl_trans', 'transl'];
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

/** The arrays that can be read; those of texts and objects are left out. */
function readArrays(bytes: Uint8Array): Map<string, NpzArray> {
  const arrays = new Map<string, NpzArray>();
  let failure: unknown = null;
  for (const [name, content] of unzipArrays(bytes, MAX_BYTES, damaged)) {
    try {
      arrays.set(name, readNpy(content, name.slice(0, 40), damaged));
    } catch (error) {
      failure ??= error;
    }
  }
  if (arrays.size === 0 && failure) throw failure as Error;
  return arrays;
}

/** Frames and joints of an array of joints, (T, J, 3), (1, T, J, 3) or (T, 3 J); null for another array. */
function jointShape({ shape }: NpzArray): { frames: number; count: number } | null {
  const sizes = shape.length > 2 && shape[0] === 1 ? shape.slice(1) : shape;
  const [frames = 0, second = 0, third] = sizes;
  const count = sizes.length === 3 && third === 3 ? second : sizes.length === 2 ? second / 3 : 0;
  return JOINT_COUNTS.includes(count) ? { frames, count } : null;
}

/** Names of the arrays of joints, the leader's first. */
function dancersIn(arrays: ReadonlyMap<string, NpzArray>): string[] {
  const names = [...arrays].filter(([, array]) => jointShape(array)).map(([name]) => name);
  return names.sort((a, b) => Number(/leader|lead$/i.test(b)) - Number(/leader|lead$/i.test(a)));
}

/** The frame rate that the archive states, or the usual one. */
function rateOf(arrays: ReadonlyMap<string, NpzArray>): Pick<MotionSource, 'frameRate' | 'rateAssumed'> {
  const array = RATES.map((name) => arrays.get(name)).find((found) => found?.data.length === 1);
  const rate = array?.data[0];
  return {
    frameRate: () => (rate === undefined ? ASSUMED_FPS : checkedRate(rate)),
    rateAssumed: rate === undefined,
  };
}

/**
 * Reads .npy and .npz files: joints (T, 22, 3), (T, 55, 3) and alike or flat, and rotations of SMPL bodies as AMASS has
 * them.
 *
 * @param part number of the dancer in an archive with several arrays of joints
 * @throws {AppError} `unreadable-file`, `not-motion`, `too-long` or `too-few-frames`
 */
export function readNumpy(bytes: Uint8Array, name: string, part: number): MotionSource {
  const isArchive = bytes[0] === 0x50 && bytes[1] === 0x4b;
  const arrays = isArchive
    ? readArrays(bytes)
    : new Map([['joints', readNpy(bytes, name.slice(0, 40), damaged)]]);
  const first = (names: readonly string[]) =>
    names.map((one) => arrays.get(one)).find((found) => found !== undefined) ?? null;
  const rotations = first(ROTATIONS);
  if (rotations?.shape.length === 2 && (rotations.shape[1] ?? 0) >= BODY_ROTATIONS) {
    const [frames = 0, width = 0] = rotations.shape;
    const trans = first(PLACES);
    const fits = trans?.shape.length === 2 && trans.shape[0] === frames && trans.shape[1] === 3;
    const error = tooLong(frames, Math.min(width, BODY_ROTATIONS));
    if (error) throw error;
    return sourceOfRotations(rotations, fits ? trans : null, rateOf(arrays));
  }
  const dancers = dancersIn(arrays);
  const chosen = dancers[part] ?? dancers[0];
  const array = chosen === undefined ? undefined : arrays.get(chosen);
  if (chosen === undefined || !array) throw noJoints(arrays);
  const { frames, count } = jointShape(array)!;
  const error = tooLong(frames, count * 3);
  if (error) throw error;
  return sourceOfPositions(bodyOf(array.data, count)!, {
    format: isArchive ? 'NPZ' : 'NPY',
    ...rateOf(arrays),
    unit: null,
    upAxis: null,
    parts: dancers.length > 1 ? dancers : [],
    part: dancers.indexOf(chosen),
  });
}

function noJoints(arrays: ReadonlyMap<string, NpzArray>): AppError {
  const seen = [...arrays]
    .slice(0, 6)
    .map(([name, { shape }]) => `${name.slice(0, 24)} (${shape.join(', ')})`);
  return new AppError(
    'not-motion',
    `No array in this file is a motion; it holds ${seen.join(', ') || 'none that can be read'}.`,
    'A motion is an array (T, 22, 3) or (T, 55, 3) of joints in the order of SMPL, or poses and trans as AMASS has them.',
  );
}
