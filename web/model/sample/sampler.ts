import { yieldToEvents } from '../../common/yield-to-events';
import type { Manifest } from '../manifest';
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
 * another, so some of them go through all steps before the others do. The last block may reach beyond the clip.
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latent, schedule, noise, blocksPerRun } = sampling;
  const width = latent.layers.length * latent.channels;
  const total = Math.ceil(noise.length / (latent.block * width));
  const result = new Float32Array(noise.length);
  for (let first = 0; first < total; first += blocksPerRun) {
    const blocks = Math.min(blocksPerRun, total - first);
    const sampled = await sampleBlocks(sampling, first, blocks, (step) =>
      sampling.onProgress?.(first * schedule.length + step * blocks, schedule.length * total),
    );
    const at = first * latent.block * width;
    result.set(sampled.subarray(0, result.length - at), at);
  }
  return result;
}

/**
 * @param first block
 * @param blocks how many
 * @returns blocks x block x layers x channels
 */
async function sampleBlocks(
  { latent, schedule, memory, keep, noise, runStep, signal }: Sampling,
  first: number,
  blocks: number,
  onStep: (done: number) => void,
): Promise<Float32Array> {
  const begin = first * latent.block;
  const size = blocks * latent.block;
  /** The rows of these blocks, zeros beyond the end of the clip. */
  const padded = (rows: Float32Array, width: number): Float32Array => {
    const out = new Float32Array(size * width);
    out.set(rows.subarray(begin * width, (begin + size) * width));
    return out;
  };
  const latents = memory.length / latent.memory_width;
  const conditions = {
    blocks,
    memory: padded(memory, latent.memory_width),
    valid: new Float32Array(size).fill(1, 0, latents - begin),
    keep,
  };
  const start = padded(noise, latent.layers.length * latent.channels);
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
