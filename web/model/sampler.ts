import { gather, partition, scatter, validity } from './blocks';
import type { Manifest } from './manifest';
import type { ScheduleStep } from './schedule';
import { nextTurn } from './turn';

/** Inputs of the step graph; `width` is layers x channels. */
export interface StepInput {
  readonly blocks: number;
  /** blocks x block x width, noisy latents. */
  readonly x: Float32Array;
  /** blocks x block x width, the clean latents that the step before predicted; zero at the first step. */
  readonly x0Prev: Float32Array;
  /** blocks x block x width, standard normal. */
  readonly noise: Float32Array;
  /** blocks x block x memory width, of the condition graph. */
  readonly memory: Float32Array;
  /** blocks x block, 1 inside the clip and 0 in padding. */
  readonly valid: Float32Array;
  readonly time: number;
  /** streams x layers, s of the paper's Eq. 9. */
  readonly guidance: Float32Array;
  readonly coefficients: readonly [number, number, number, number];
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
  /** Noise of one draw, latents x width: draw 0 starts the sampling, draw k + 1 belongs to step k. */
  readonly noise: (draw: number) => Float32Array;
  readonly runStep: StepRunner;
  /** Blocks that go through the graph together: bounds the memory of a long clip, changes nothing else. */
  readonly blocksPerRun: number;
  readonly signal?: AbortSignal | undefined;
  /** Called as blocks are done: `done` of `total` block computations of the whole sampling. */
  readonly onProgress?: ((done: number, total: number) => void) | undefined;
  /** Called after every step with the state (latents x width, valid during the call only). */
  readonly onStep?: ((step: number, x: Float32Array, x0: Float32Array) => void) | undefined;
}

/**
 * Sample latents for a whole clip, all blocks of a step before the next step.
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latent, latents, schedule, signal, blocksPerRun } = sampling;
  const width = latent.layers.length * latent.channels;
  const size = latent.block;
  const partitions = schedule.map((_, k) =>
    partition(latents, size, sampling.alternatingPhase && k % 2 === 1),
  );
  const total = partitions.reduce((sum, blocks) => sum + blocks.length, 0);
  let done = 0;
  let x = sampling.noise(0);
  let x0 = new Float32Array(latents * width);
  for (const [k, { time, coefficients }] of schedule.entries()) {
    const noise = coefficients[3] === 0 ? new Float32Array(latents * width) : sampling.noise(k + 1);
    const nextX = new Float32Array(latents * width);
    const nextX0 = new Float32Array(latents * width);
    const blocks = partitions[k] ?? [];
    for (let first = 0; first < blocks.length; first += blocksPerRun) {
      await nextTurn(signal);
      const group = blocks.slice(first, first + blocksPerRun);
      const output = await sampling.runStep({
        blocks: group.length,
        x: gather(x, width, group, size),
        x0Prev: gather(x0, width, group, size),
        noise: gather(noise, width, group, size),
        memory: gather(sampling.memory, latent.memory_width, group, size),
        valid: validity(group, size),
        time,
        guidance: sampling.guidance,
        coefficients,
      });
      scatter(nextX, width, output.x, group, size);
      scatter(nextX0, width, output.x0, group, size);
      done += group.length;
      sampling.onProgress?.(done, total);
    }
    x = nextX;
    x0 = nextX0;
    sampling.onStep?.(k, x, x0);
  }
  return x;
}
