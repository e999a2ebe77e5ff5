import type { Manifest } from '../manifest';
import { blend, layerGains } from '../sample/blend';
import { BranchSampler } from '../sample/branch-sampler';
import { type NpzArray, readNpz } from './npz';
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
  readonly steps: number;
  /** 22 bone lengths, metres. */
  readonly bones: Float32Array;
  /** T x 22 x 3 metres. */
  readonly reactor: Float32Array;
}

/** Reads the golden sampling from the archive beside a manifest. */
export function readGolden(bytes: Uint8Array): Golden {
  const arrays = readNpz(bytes);
  const array = (name: string): NpzArray => {
    const found = arrays.get(name);
    if (found === undefined) throw new Error(`The golden file has no array "${name}".`);
    return found;
  };
  const floats = (name: string): Float32Array => Float32Array.from(array(name).data);
  const number = (name: string): number => array(name).data[0] ?? NaN;
  return {
    leader: floats('leader'),
    music: floats('music'),
    musicValid: floats('music_valid'),
    role: number('role'),
    guidance: interleaved(floats('coarse'), floats('fine')),
    musicGuidance: number('music_guidance'),
    seed: number('seed'),
    steps: number('steps'),
    bones: floats('bones'),
    reactor: floats('reactor'),
  };
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
  const branches = await new BranchSampler(manifest, session).branches(golden, golden, wanted);
  // Not by decodeClip, which refuses numbers that are not finite.
  const { reactor } = await session.decode({
    latents: blend(branches, { ...golden, variety: 1 }, latent),
    leader: golden.leader,
    gains: layerGains(golden.guidance, latent),
    bones: golden.bones,
  });
  let worst = 0;
  for (let i = 0; i < golden.reactor.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => (reactor[i + axis] ?? NaN) - (golden.reactor[i + axis] ?? NaN));
    worst = Math.max(worst, Math.hypot(x ?? NaN, y ?? NaN, z ?? NaN));
  }
  return worst;
}
