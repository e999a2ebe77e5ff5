import type { Manifest } from '../manifest';
import type { ModelSession } from '../load/session';
import type { Branches } from './blend';
import { conditionClip } from './condition';
import type { ConditionInput } from './graphs';
import { noise } from './noise';
import { sample } from './sampler';
import { ddim } from './schedule';

/** A minute of dance at a time bounds the memory of the condition graph's convolutions. */
const LATENTS_PER_CHUNK = 480;
/** Bounds the memory of attention in the step graph. */
const BLOCKS_PER_RUN = 16;
/** Seeds whose latents are kept. */
const KEPT_SEEDS = 8;

type Branch = keyof Branches;

/** Memory and latents of one leader and song. */
interface Known {
  readonly input: ConditionInput;
  readonly memories: Map<'song' | 'silence', Float32Array>;
  /** By seed and steps, the one used last at the end. */
  readonly latents: Map<string, Map<Branch, Float32Array>>;
}

export interface BranchOptions {
  readonly signal?: AbortSignal | undefined;
  readonly onCondition?: ((done: number, total: number) => void) | undefined;
  readonly onStep?: ((done: number, total: number) => void) | undefined;
}

/** Samples the branches that guidance blends, each once: as long as leader and song stay, they are kept by seed. */
export class BranchSampler {
  #known: Known | undefined;

  constructor(
    readonly manifest: Manifest,
    readonly session: ModelSession,
  ) {}

  /**
   * The conditional branch and those that are asked for beside it, from the same noise. Without a song the silent
   * branch is the conditional one and is left out.
   * @throws the signal's reason, between two graph runs
   */
  async branches(
    input: ConditionInput,
    { seed, steps }: { readonly seed: number; readonly steps: number },
    wanted: { readonly silent: boolean; readonly unconditional: boolean },
    { signal, onCondition, onStep }: BranchOptions = {},
  ): Promise<Branches> {
    const known = this.#knownFor(input);
    const song = input.musicValid.some((valid) => valid !== 0);
    const list: Branch[] = ['conditional'];
    if (wanted.silent && song) list.push('silent');
    if (wanted.unconditional) list.push('unconditional');
    const latents = kept(known.latents, `${seed} ${steps}`);
    const missing = list.filter((branch) => !latents.has(branch));
    for (const [i, branch] of missing.entries()) {
      const memory = await this.#memory(known, branch !== 'silent' && song, signal, onCondition);
      const sampled = await this.#sample(memory, branch, seed, steps, signal, (done, total) =>
        onStep?.(i * total + done, missing.length * total),
      );
      latents.set(branch, sampled);
    }
    return {
      conditional: latents.get('conditional')!,
      silent: list.includes('silent') ? latents.get('silent')! : null,
      unconditional: list.includes('unconditional') ? latents.get('unconditional')! : null,
    };
  }

  #knownFor(input: ConditionInput): Known {
    if (!this.#known || !sameInput(this.#known.input, input))
      this.#known = { input, memories: new Map(), latents: new Map() };
    return this.#known;
  }

  /** The memory with the song or in silence; what the unconditional branch gets is not read. */
  async #memory(
    { input, memories }: Known,
    withSong: boolean,
    signal: AbortSignal | undefined,
    onProgress: ((done: number, total: number) => void) | undefined,
  ): Promise<Float32Array> {
    const key = withSong ? 'song' : 'silence';
    const found = memories.get(key);
    if (found) return found;
    const heard = withSong ? input : { ...input, musicValid: new Float32Array(input.musicValid.length) };
    const memory = await conditionClip(this.session.condition, heard, this.manifest, LATENTS_PER_CHUNK, {
      signal,
      onProgress,
    });
    memories.set(key, memory);
    return memory;
  }

  #sample(
    memory: Float32Array,
    branch: Branch,
    seed: number,
    steps: number,
    signal: AbortSignal | undefined,
    onProgress: (done: number, total: number) => void,
  ): Promise<Float32Array> {
    const { latent, diffusion } = this.manifest;
    const latents = memory.length / latent.memory_width;
    return sample({
      latent,
      alternatingPhase: diffusion.alternating_phase,
      schedule: ddim(diffusion, steps),
      memory,
      keep: branch === 'unconditional' ? 0 : 1,
      noise: noise(seed, latents, latent.layers.length * latent.channels),
      runStep: this.session.step,
      blocksPerRun: BLOCKS_PER_RUN,
      signal,
      onProgress,
    });
  }
}

/** The latents under a key, which becomes the one used last; beyond `KEPT_SEEDS` the oldest key is dropped. */
function kept(
  all: Map<string, Map<Branch, Float32Array>>,
  key: string,
): Map<Branch, Float32Array> {
  const latents = all.get(key) ?? new Map<Branch, Float32Array>();
  all.delete(key);
  all.set(key, latents);
  const oldest = all.keys().next();
  if (all.size > KEPT_SEEDS && !oldest.done) all.delete(oldest.value);
  return latents;
}

function sameInput(a: ConditionInput, b: ConditionInput): boolean {
  return (
    a.role === b.role &&
    equal(a.leader, b.leader) &&
    equal(a.musicValid, b.musicValid) &&
    equal(a.music, b.music)
  );
}

function equal(a: Float32Array, b: Float32Array): boolean {
  return a.length === b.length && a.every((value, i) => value === b[i]);
}
