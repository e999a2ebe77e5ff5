import { yieldToEvents } from '../../common/yield-to-events';
import type { Manifest } from '../manifest';
import { type Block, gather, partition, scatter, validity } from './blocks';
import type { HeldLatents, StepRunner } from './graphs';
import type { ScheduleStep } from './schedule';

export interface Sampling {
  readonly latent: Manifest['latent'];
  readonly schedule: readonly ScheduleStep[];
  /** latents x memory width. */
  readonly memory: Float32Array;
  /** 1 with leader and song as the memory has them, 0 without both. */
  readonly keep: number;
  /** Standard normal noise that sampling starts from, latents x width; it is not changed. */
  readonly noise: Float32Array;
  readonly runStep: StepRunner;
  /** Blocks that go through the graph together: bounds the memory of a long clip, changes nothing else. */
  readonly blocksPerRun: number;
  readonly signal?: AbortSignal | undefined;
  /** Called as blocks are done: `done` of `total` block computations of the whole sampling. */
  readonly onProgress?: ((done: number, total: number) => void) | undefined;
}

/**
 * Samples the latents of a whole clip by DDIM, block by block (blockwise local context, paper 3.4): no block needs
 * another, so some of them go through all steps before the others do.
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latent, schedule, noise, blocksPerRun } = sampling;
  const width = latent.layers.length * latent.channels;
  const blocks = partition(noise.length / width, latent.block);
  const result = new Float32Array(noise.length);
  for (let first = 0; first < blocks.length; first += blocksPerRun) {
    const some = blocks.slice(first, first + blocksPerRun);
    const sampled = await sampleBlocks(sampling, some, (step) => {
      const done = first * schedule.length + step * some.length;
      sampling.onProgress?.(done, schedule.length * blocks.length);
    });
    scatter(result, width, sampled, some, latent.block);
  }
  return result;
}

/** @returns blocks x block x layers x channels */
async function sampleBlocks(
  { latent, schedule, memory, keep, noise, runStep, signal }: Sampling,
  blocks: readonly Block[],
  onStep: (done: number) => void,
): Promise<Float32Array> {
  const conditions = {
    blocks: blocks.length,
    memory: gather(memory, latent.memory_width, blocks, latent.block),
    valid: validity(blocks, latent.block),
    keep,
  };
  const start = gather(noise, latent.layers.length * latent.channels, blocks, latent.block);
  let held: HeldLatents | null = null;
  try {
    for (const [k, step] of schedule.entries()) {
      await yieldToEvents(signal);
      const next = await runStep({ ...conditions, ...step, x: held ?? start });
      held?.free();
      held = next;
      onStep(k + 1);
    }
    return held ? await held.read() : start;
  } finally {
    held?.free();
  }
}
