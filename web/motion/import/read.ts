import { type MotionFormat, FORMAT_BYTES, motionFormat } from './format';
import { type LeaderFile, leaderOf } from '../retarget/leader';
import type { ImportOptions, RememberedJoints } from '../retarget/options';
import type { MotionSource } from '../retarget/source';
import { AppError } from '../../common/error';
import { loadPart } from '../../common/page-part';

/** A file with its name, as bytes. */
export interface FileBytes {
  readonly name: string;
  readonly bytes: Uint8Array;
}

/** What a reader makes of the files, the one with the motion first. `part` is the number of a clip or dancer. */
type Reader = (files: readonly [FileBytes, ...FileBytes[]], part: number) => MotionSource;

/** Largest motion file, bytes. */
const MAX_BYTES = 512 * 1024 * 1024;

const text = (file: FileBytes): string => new TextDecoder().decode(file.bytes);

/** The readers by format, each in a part of the page of its own that is loaded when it is needed. */
const READERS: Readonly<Record<MotionFormat, () => Promise<Reader>>> = {
  bvh: async () => {
    const { readBvh } = await import('./bvh/read');
    return ([file], part) => readBvh(text(file), part);
  },
  fbx: async () => {
    const { readFbx } = await import('./fbx/read');
    return ([file], part) => readFbx(file.bytes, part);
  },
  gltf: async () => {
    const { readGltf } = await import('./gltf/read');
    return readGltf;
  },
  vmd: async () => {
    const { readVmd } = await import('./vmd/read');
    return ([file]) => readVmd(file.bytes);
  },
  amc: async () => {
    const { readAmc } = await import('./amc/read');
    return readAmc;
  },
  c3d: async () => {
    const { readC3d } = await import('./c3d/read');
    return ([file], part) => readC3d(file.bytes, part);
  },
  numpy: async () => {
    const { readNumpy } = await import('./numpy/read');
    return ([file], part) => readNumpy(file.bytes, file.name, part);
  },
  json: async () => {
    const { readJsonMotion } = await import('./tables/json');
    return ([file], part) => readJsonMotion(text(file), part);
  },
  csv: async () => {
    const { readCsv } = await import('./tables/csv');
    return ([file], part) => readCsv(text(file), part);
  },
  trc: async () => {
    const { readTrc } = await import('./tables/trc');
    return ([file]) => readTrc(text(file));
  },
};

/**
 * Reads a motion file of any known format, with the files that belong to it.
 *
 * @throws {AppError} `not-motion` for a file of no known format, `too-large`, `page-part-missing` without a connection
 *   where the format was never read before, and what its reader says
 */
export async function readMotion(
  files: readonly FileBytes[],
  options: Pick<ImportOptions, 'part'> = {},
): Promise<MotionSource> {
  const [file, ...companions] = files;
  const format = file && motionFormat(file.bytes.subarray(0, FORMAT_BYTES), file.name);
  if (!file || !format) {
    throw new AppError(
      'not-motion',
      'This is not a motion file in a format that can be read here.',
      'Use BVH, FBX, glTF, VRMA, VMD, AMC with ASF, C3D, NPZ, NPY, JSON, CSV or TRC.',
    );
  }
  if (file.bytes.length > MAX_BYTES) {
    throw new AppError(
      'too-large',
      `The file has ${Math.round(file.bytes.length / 1024 ** 2)} MB; up to ${MAX_BYTES / 1024 ** 2} MB are read.`,
      'Export the motion alone, without meshes and textures, or a shorter part of it.',
    );
  }
  const read = await loadPart(READERS[format]);
  return read([file, ...companions], options.part ?? 0);
}

/**
 * Reads a dancer from a motion file.
 *
 * @param remembered joints that were chosen for skeletons of earlier files
 * @throws {AppError} if the file cannot be read, with a sentence and a hint
 */
export async function readLeaderFile(
  files: readonly FileBytes[],
  options: ImportOptions = {},
  remembered: RememberedJoints = {},
): Promise<LeaderFile> {
  return leaderOf(await readMotion(files, options), options, remembered);
}
