import { conditionClip } from '../sample/condition';
import type { Manifest } from '../manifest';
import { noise } from '../sample/noise';
import { type NpzArray, readNpz } from './npz';
import { sample } from '../sample/sampler';
import { ddim } from '../sample/schedule';
import type { ModelSession } from './session';

/** One small sampling as Python computed it: its inputs and its result. */
export interface Golden {
  readonly leader: Float32Array;
  readonly music: Float32Array;
  readonly musicValid: Float32Array;
  readonly role: number;
  readonly guidance: Float32Array;
  readonly musicGuidance: number;
  readonly seed: number;
  readonly steps: number;
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
    guidance: floats('guidance'),
    musicGuidance: number('music_guidance'),
    seed: number('seed'),
    steps: number('steps'),
    reactor: floats('reactor'),
  };
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
  const { latent, diffusion } = manifest;
  const latents = golden.musicValid.length / latent.stride;
  const memory = await conditionClip(session.condition, golden, manifest, latents);
  const sampled = await sample({
    latent,
    alternatingPhase: diffusion.alternating_phase,
    schedule: ddim(diffusion, golden.steps),
    latents,
    memory,
    guidance: golden.guidance,
    musicGuidance: golden.musicGuidance,
    noise: noise(golden.seed, latents, latent.layers.length * latent.channels),
    runStep: session.step,
    blocksPerRun: latents,
  });
  const layers = new Float32Array(latent.layers.length).fill(1);
  const reactor = await session.decode({ latents: sampled, leader: golden.leader, layers });
  let worst = 0;
  for (let i = 0; i < golden.reactor.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => (reactor[i + axis] ?? NaN) - (golden.reactor[i + axis] ?? NaN));
    worst = Math.max(worst, Math.hypot(x ?? NaN, y ?? NaN, z ?? NaN));
  }
  return worst;
}
