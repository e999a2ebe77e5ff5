import type { Manifest } from '../manifest';
import type { ModelSession } from '../load/session';
import type { Branches, NeededBranches } from './blend';
import { BranchCache } from './branch-cache';
import { conditionClip } from './condition';
import type { ConditionInput } from './graphs';
import { noise } from './noise';
import { sample } from './sampler';
import { ddim } from './schedule';

/** A minute of dance at a time bounds the memory of the condition graph's convolutions. */
const LATENTS_PER_CHUNK = 480;
/** Bounds the memory of attention in the step graph. */
const BLOCKS_PER_RUN = 16;

type Condition = Awaited<ReturnType<typeof conditionClip>>;
type Branch = Exclude<keyof Branches, 'mean'>;

/** What the condition graph says of one leader and song, and the latents sampled for them. */
interface Known {
  readonly input: ConditionInput;
  readonly conditions: Map<'song' | 'silence', Condition>;
  readonly latents: BranchCache<Branch>;
  /** Mean coarse layer of several seeds, once it was needed. */
  mean: Float32Array | null;
}

export interface BranchOptions {
  readonly signal?: AbortSignal | undefined;
  readonly onCondition?: ((done: number, total: number) => void) | undefined;
  readonly onStep?: ((done: number, total: number) => void) | undefined;
}

interface SampledBranches extends Branches {
  /** Of the leader, mean over the clip. */
  readonly unfamiliarity: number;
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
    seed: number,
    wanted: NeededBranches,
    { signal, onCondition, onStep }: BranchOptions = {},
  ): Promise<SampledBranches> {
    const known = this.#knownFor(input);
    const song = input.musicValid.some((valid) => valid !== 0);
    const list: Branch[] = ['conditional'];
    if (wanted.silent && song) list.push('silent');
    if (wanted.unconditional) list.push('unconditional');
    // A copy: other seeds may be sampled meanwhile, and push this one out of the cache.
    const latents = new Map(known.latents.group(seed));
    const missing = list.filter((branch) => !latents.has(branch));
    const { seeds } = this.manifest.guidance.variety;
    const meanMissing = wanted.mean && !known.mean;
    const runs = missing.length + (meanMissing ? seeds : 0);
    let run = 0;
    const sampleNext = async (branch: Branch, of: number): Promise<Float32Array> => {
      const before = run++;
      // Later conditions come between steps, where this stage is over.
      const report = before === 0 ? onCondition : undefined;
      const { memory } = await this.#condition(known, branch !== 'silent' && song, signal, report);
      return this.#sample(memory, branch, of, signal, (done, total) =>
        onStep?.(before * total + done, runs * total),
      );
    };
    for (const branch of missing) {
      const sampled = await sampleNext(branch, seed);
      latents.set(branch, sampled);
      known.latents.add(seed, branch, sampled);
    }
    if (meanMissing) {
      const coarse: Float32Array[] = [];
      for (let of = 0; of < seeds; of++)
        coarse.push(coarseLayer(await sampleNext('conditional', of), this.manifest.latent));
      known.mean = mean(coarse);
    }
    const { unfamiliarity } = await this.#condition(known, song, signal);
    return {
      unfamiliarity,
      conditional: latents.get('conditional')!,
      silent: list.includes('silent') ? latents.get('silent')! : null,
      unconditional: list.includes('unconditional') ? latents.get('unconditional')! : null,
      mean: wanted.mean ? known.mean : null,
    };
  }

  #knownFor(input: ConditionInput): Known {
    if (!this.#known || !sameInput(this.#known.input, input))
      this.#known = { input, conditions: new Map(), latents: new BranchCache(), mean: null };
    return this.#known;
  }

  /** With the song or in silence; what the unconditional branch gets is not read. */
  async #condition(
    { input, conditions }: Known,
    withSong: boolean,
    signal: AbortSignal | undefined,
    onProgress?: (done: number, total: number) => void,
  ): Promise<Condition> {
    const key = withSong ? 'song' : 'silence';
    const found = conditions.get(key);
    if (found) return found;
    const heard = withSong ? input : { ...input, musicValid: new Float32Array(input.musicValid.length) };
    const condition = await conditionClip(this.session.condition, heard, this.manifest, LATENTS_PER_CHUNK, {
      signal,
      onProgress,
    });
    conditions.set(key, condition);
    return condition;
  }

  #sample(
    memory: Float32Array,
    branch: Branch,
    seed: number,
    signal: AbortSignal | undefined,
    onProgress: (done: number, total: number) => void,
  ): Promise<Float32Array> {
    const { latent, diffusion } = this.manifest;
    const latents = memory.length / latent.memory_width;
    return sample({
      latent,
      schedule: ddim(diffusion),
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

/** The first layer of latents: latents x layers x channels to latents x channels. */
function coarseLayer(latents: Float32Array, { layers, channels }: Manifest['latent']): Float32Array {
  const coarse = new Float32Array(latents.length / layers.length);
  for (let at = 0; at < coarse.length; at += channels)
    coarse.set(latents.subarray(at * layers.length, at * layers.length + channels), at);
  return coarse;
}

function mean(all: readonly Float32Array[]): Float32Array {
  const sum = new Float64Array(all[0]?.length ?? 0);
  for (const values of all) values.forEach((value, i) => (sum[i]! += value));
  return Float32Array.from(sum, (value) => value / all.length);
}

function sameInput(a: ConditionInput, b: ConditionInput): boolean {
  if (a === b) return true;
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
