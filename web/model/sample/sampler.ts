import { yieldToEvents } from '../../common/yield-to-events';
import type { Manifest } from '../manifest';
import { gather, partition, scatter, validity } from './blocks';
import type { StepRunner } from './graphs';
import type { ScheduleStep } from './schedule';

export interface Sampling {
  readonly latent: Manifest['latent'];
  /** Whether every second step uses the partition that is shifted by half a block. */
  readonly alternatingPhase: boolean;
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
 * Samples the latents of a whole clip by DDIM, block by block (block-wise local conditioning, paper 3.4).
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latent, schedule, memory, keep, noise, runStep, blocksPerRun, signal } = sampling;
  const width = latent.layers.length * latent.channels;
  const frames = noise.length / width;
  const blocksOf = (step: number) =>
    partition(frames, latent.block, sampling.alternatingPhase && step % 2 === 1);
  const total = schedule.reduce((sum, _, step) => sum + blocksOf(step).length, 0);
  let done = 0;
  let x = noise;
  for (const [step, { time, coefficients }] of schedule.entries()) {
    const next = new Float32Array(x.length);
    const blocks = blocksOf(step);
    for (let first = 0; first < blocks.length; first += blocksPerRun) {
      const some = blocks.slice(first, first + blocksPerRun);
      await yieldToEvents(signal);
      const output = await runStep({
        blocks: some.length,
        x: gather(x, width, some, latent.block),
        memory: gather(memory, latent.memory_width, some, latent.block),
        valid: validity(some, latent.block),
        keep,
        time,
        coefficients,
      });
      scatter(next, width, output, some, latent.block);
      done += some.length;
      sampling.onProgress?.(done, total);
    }
    x = next;
  }
  return x;
}
