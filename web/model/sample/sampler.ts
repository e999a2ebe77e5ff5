import { type Block, gather, partition, scatter, validity } from './blocks';
import type { Manifest } from '../manifest';
import type { ScheduleStep } from './schedule';
import { planParts } from './block-order';
import { yieldToEvents } from '../../common/yield-to-events';

/** Inputs of the step graph; `width` is layers x channels. */
export interface StepInput {
  readonly blocks: number;
  /** blocks x block x width, noisy latents. */
  readonly x: Float32Array;
  /** blocks x block x memory width, of the condition graph. */
  readonly memory: Float32Array;
  /** blocks x block, 1 inside the clip and 0 in padding. */
  readonly valid: Float32Array;
  readonly time: number;
  /** streams x layers, s of the paper's Eq. 9. */
  readonly guidance: Float32Array;
  /** Weight of the guidance by music, which is added to Eq. 9. */
  readonly musicGuidance: number;
  readonly coefficients: readonly [number, number];
}

/** Outputs of the step graph, both blocks x block x width. */
export interface StepOutput {
  readonly x: Float32Array;
  readonly x0: Float32Array;
}

export type StepRunner = (input: StepInput) => Promise<StepOutput>;

export interface Sampling {
  readonly latent: Manifest['latent'];
  readonly alternatingPhase: boolean;
  readonly schedule: readonly ScheduleStep[];
  /** Length of the clip in latent frames. */
  readonly latents: number;
  /** latents x memory width. */
  readonly memory: Float32Array;
  readonly guidance: Float32Array;
  readonly musicGuidance: number;
  /** Standard normal noise that sampling starts from, latents x width; it is not changed. */
  readonly noise: Float32Array;
  readonly runStep: StepRunner;
  /** Blocks that go through the graph together: bounds the memory of a long clip, changes nothing else. */
  readonly blocksPerRun: number;
  readonly signal?: AbortSignal | undefined;
  /** Growing parts of the clip that are wanted one after the other, the last of them the whole; without, only that. */
  readonly parts?: readonly Block[] | undefined;
  /** Called as blocks are done: `done` of `total` block computations of the whole sampling. */
  readonly onProgress?: ((done: number, total: number) => void) | undefined;
  /** Called when a step is done for the whole clip (state latents x width, valid during the call only). */
  readonly onStep?: ((step: number, x: Float32Array, x0: Float32Array) => void) | undefined;
  /** Called when all steps are done for a part but not for the whole: its latents, length x width. */
  readonly onPart?: ((part: Block, x: Float32Array) => Promise<void>) | undefined;
}

/** Blocks of each step: with alternating phase every second step begins with half a block. */
export function partitions({ latent, latents, schedule, alternatingPhase }: Sampling): Block[][] {
  return schedule.map((_, k) => partition(latents, latent.block, alternatingPhase && k % 2 === 1));
}

/** State after one step, latents x width each. */
interface Level {
  readonly x: Float32Array;
  readonly x0: Float32Array;
}

/**
 * Sample latents for a whole clip. The order of the work changes nothing in the result: blocks of a step know of each
 * other only through the step before.
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latent, latents, schedule, signal, blocksPerRun } = sampling;
  const width = latent.layers.length * latent.channels;
  const size = latent.block;
  const cut = partitions(sampling);
  const total = cut.flat().length;
  const empty = (): Level => ({
    x: new Float32Array(latents * width),
    x0: new Float32Array(latents * width),
  });
  const levels = new Map<number, Level>([[0, { x: sampling.noise, x0: sampling.noise }]]);
  const left = cut.map((blocks) => blocks.length);
  let done = 0;

  const compute = async (k: number, group: readonly Block[]): Promise<void> => {
    const step = schedule[k];
    if (!step) return;
    const before = kept(levels, k, empty);
    const after = kept(levels, k + 1, empty);
    await yieldToEvents(signal);
    const output = await sampling.runStep({
      blocks: group.length,
      x: gather(before.x, width, group, size),
      memory: gather(sampling.memory, latent.memory_width, group, size),
      valid: validity(group, size),
      time: step.time,
      guidance: sampling.guidance,
      musicGuidance: sampling.musicGuidance,
      coefficients: step.coefficients,
    });
    scatter(after.x, width, output.x, group, size);
    scatter(after.x0, width, output.x0, group, size);
    done += group.length;
    sampling.onProgress?.(done, total);
    const rest = (left[k] ?? 0) - group.length;
    left[k] = rest;
    if (rest > 0) return;
    sampling.onStep?.(k, after.x, after.x0);
    levels.delete(k); // nothing will read it any more
  };

  for (const { runs, part } of planParts(cut, sampling.parts ?? [{ start: 0, length: latents }])) {
    for (const { step, blocks } of runs) {
      for (let first = 0; first < blocks.length; first += blocksPerRun) {
        await compute(step, blocks.slice(first, first + blocksPerRun));
      }
    }
    const { x } = kept(levels, schedule.length, empty);
    if (done === total) return x;
    await sampling.onPart?.(part, x.slice(part.start * width, (part.start + part.length) * width));
  }
  throw new Error('the last part of a sampling has to be the whole clip');
}

/** The value of a key, made when it is first asked for. */
function kept<K, V>(map: Map<K, V>, key: K, make: () => V): V {
  const found = map.get(key);
  if (found !== undefined) return found;
  const made = make();
  map.set(key, made);
  return made;
}
