import { AppError } from '../../common/error';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { Manifest } from '../manifest';
import { blend, layerGains } from '../sample/blend';
import { BranchSampler } from '../sample/branch-sampler';
import { SEEDS } from '../sample/inputs';
import { readNpz } from './npz';
import type { NpzArray } from '../../common/npz';
import type { ModelSession } from './session';

/** One small sampling as Python computed it: its inputs and its result. */
export interface Golden {
  readonly leader: Float32Array;
  readonly music: Float32Array;
  readonly musicValid: Float32Array;
  readonly role: number;
  /** streams x layers. */
  readonly guidance: Float32Array;
  readonly musicGuidance: number;
  readonly seed: number;
  /** T x 22 x 3 metres. */
  readonly reactor: Float32Array;
}

/** Largest number of motion frames of a golden sampling; what is exported has 480. */
const MAX_FRAMES = 10_000;

/**
 * Reads the golden sampling from the archive beside a manifest.
 *
 * @throws {AppError} `model-corrupt` where an array is missing, or of another size than the others
 */
export function readGolden(bytes: Uint8Array): Golden {
  const arrays = readNpz(bytes);
  const array = (name: string): NpzArray => {
    const found = arrays.get(name);
    if (found === undefined) throw invalid(`has no array "${name}"`);
    return found;
  };
  const frames = array('music_valid').data.length;
  if (frames < 1 || frames > MAX_FRAMES) throw invalid(`has ${frames} frames, not 1 to ${MAX_FRAMES}`);
  const shaped = (name: string, ...shape: readonly (number | null)[]): Float32Array => {
    const found = array(name);
    const fits =
      found.shape.length === shape.length &&
      shape.every((length, axis) => length === null || length === found.shape[axis]);
    if (!fits) throw invalid(`has an array "${name}" of the wrong size, (${found.shape.join(', ')})`);
    return Float32Array.from(found.data);
  };
  const number = (name: string): number => shaped(name, 1)[0]!;
  const coarse = shaped('coarse', null);
  const seed = number('seed');
  if (!Number.isInteger(seed) || seed < SEEDS.min || seed > SEEDS.max)
    throw invalid(`has a "seed" of ${seed}, not a whole number from ${SEEDS.min} to ${SEEDS.max}`);
  return {
    leader: shaped('leader', frames, JOINT_COUNT, 3),
    music: shaped('music', frames, null),
    musicValid: shaped('music_valid', frames),
    role: number('role'),
    guidance: interleaved(coarse, shaped('fine', coarse.length)),
    musicGuidance: number('music_guidance'),
    seed,
    reactor: shaped('reactor', frames, JOINT_COUNT, 3),
  };
}

function invalid(what: string): AppError {
  return new AppError(
    'model-corrupt',
    `The example dance that the model is checked with ${what}.`,
    'Export the model again and copy its whole folder.',
  );
}

/** Weights of coarse and fine, one a stream each, as streams x layers. */
function interleaved(coarse: Float32Array, fine: Float32Array): Float32Array {
  return Float32Array.from({ length: 2 * coarse.length }, (_, i) => (i % 2 === 0 ? coarse : fine)[i >> 1]!);
}

/**
 * Repeats the golden sampling on a session.
 * @returns metres between its joints and Python's where they differ most, NaN if a number is not finite
 */
export async function goldenError(
  manifest: Manifest,
  session: ModelSession,
  golden: Golden,
): Promise<number> {
  const { latent } = manifest;
  const wanted = { silent: true, unconditional: true, mean: false };
  const branches = await new BranchSampler(manifest, session).branches(golden, golden.seed, wanted);
  // Not by decodeClip, which refuses numbers that are not finite.
  const reactor = await session.decode({
    latents: blend(branches, { ...golden, variety: 1 }, latent),
    leader: golden.leader,
    gains: layerGains(golden.guidance, latent),
    role: golden.role,
  });
  let worst = 0;
  for (let i = 0; i < golden.reactor.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => (reactor[i + axis] ?? NaN) - (golden.reactor[i + axis] ?? NaN));
    worst = Math.max(worst, Math.hypot(x ?? NaN, y ?? NaN, z ?? NaN));
  }
  return worst;
}
