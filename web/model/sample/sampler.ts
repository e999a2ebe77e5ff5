import { yieldToEvents } from '../../common/yield-to-events';
import type { Manifest } from '../manifest';
import { gather, partition, scatter, validity } from './blocks';
import type { StepRunner } from './graphs';
import type { ScheduleStep } from './schedule';

export interface Sampling {
  readonly latent: Manifest['latent'];
  /** How far the last prediction of each stream is extrapolated from the one before it. */
  readonly extrapolation: readonly number[];
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
 * Samples the latents of a whole clip by DDIM, block by block (block-wise local conditioning, paper 3.4). The last
 * prediction is extrapolated from the one before it, x0 + c (x0 - x0 before), as multistep solvers do (Lu et al. 2022,
 * DPM-Solver++); `sample` in Python says why.
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latent, schedule, memory, keep, noise, runStep, blocksPerRun, signal } = sampling;
  const width = latent.layers.length * latent.channels;
  const blocks = partition(noise.length / width, latent.block);
  const total = schedule.length * blocks.length;
  let done = 0;
  let x = noise;
  let before: Float32Array | undefined;
  for (const [step, { time, a, b }] of schedule.entries()) {
    const predicted = new Float32Array(x.length);
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
      });
      scatter(predicted, width, output, some, latent.block);
      done += some.length;
      sampling.onProgress?.(done, total);
    }
    if (step === schedule.length - 1 && before) extrapolate(predicted, before, sampling);
    x = x.map((value, i) => a * value + b * predicted[i]!);
    before = predicted;
  }
  return x;
}

/** Adds c (x0 - x0 before) to x0, latents x layers x channels, with c of each channel's stream. */
function extrapolate(x0: Float32Array, before: Float32Array, { latent, extrapolation }: Sampling): void {
  const perStream = latent.channels / latent.streams.length;
  for (let i = 0; i < x0.length; i++) {
    const stream = Math.floor((i % latent.channels) / perStream);
    x0[i]! += extrapolation[stream]! * (x0[i]! - before[i]!);
  }
}
