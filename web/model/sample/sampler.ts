import { type Block, gather, partition, scatter, validity } from './blocks';
import type { Manifest } from '../manifest';
import type { StepRunner } from './graphs';
import type { ScheduleStep } from './schedule';
import { planParts } from './block-order';
import { yieldToEvents } from '../../common/yield-to-events';

export interface Sampling {
  readonly latent: Manifest['latent'];
  /** Whether every second step uses the partition that is shifted by half a block. */
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
  /** Growing parts of the clip to finish one after the other, the last of them the whole clip; by default only that. */
  readonly parts?: readonly Block[] | undefined;
  /** Called as blocks are done: `done` of `total` block computations of the whole sampling. */
  readonly onProgress?: ((done: number, total: number) => void) | undefined;
  /** Called when a step is done for the whole clip (latents x width, valid during the call only). */
  readonly onStep?: ((step: number, x: Float32Array, x0: Float32Array) => void) | undefined;
  /** Called when all steps are done for a part but not for the whole: its latents, length x width. */
  readonly onPart?: ((part: Block, x: Float32Array) => Promise<void>) | undefined;
}

/** Blocks of each step: one partition for all, or two in alternation. */
export function blocksByStep({ latent, latents, schedule, alternatingPhase }: Sampling): Block[][] {
  return schedule.map((_, k) => partition(latents, latent.block, alternatingPhase && k % 2 === 1));
}

/** Latents of the whole clip before the first or after some step, latents x width each. */
interface StepState {
  /** Noisy latents. */
  readonly x: Float32Array;
  /** Latents that the step predicted to be the clean ones. */
  readonly x0: Float32Array;
}

/**
 * Samples the latents of a whole clip by DDIM, block by block (block-wise local conditioning, paper 3.4). The order
 * of the blocks changes nothing in the result; see block-order.ts.
 * @returns latents x layers x channels, normalised
 * @throws the signal's reason, between two graph runs
 */
export async function sample(sampling: Sampling): Promise<Float32Array> {
  const { latents, schedule, blocksPerRun, noise } = sampling;
  const width = sampling.latent.layers.length * sampling.latent.channels;
  const steps = blocksByStep(sampling);
  const total = steps.flat().length;
  const unfinished = steps.map((blocks) => blocks.length);
  /** states[k] holds the latents before step k, as far as they are computed. */
  const states: (StepState | undefined)[] = [{ x: noise, x0: noise }];
  const stateAt = (k: number): StepState =>
    (states[k] ??= { x: new Float32Array(latents * width), x0: new Float32Array(latents * width) });
  let done = 0;

  const compute = async (k: number, blocks: readonly Block[]): Promise<void> => {
    await runBlocks(sampling, k, blocks, stateAt(k), stateAt(k + 1));
    done += blocks.length;
    sampling.onProgress?.(done, total);
    unfinished[k]! -= blocks.length;
    if (unfinished[k] !== 0) return;
    const { x, x0 } = stateAt(k + 1);
    sampling.onStep?.(k, x, x0);
    states[k] = undefined; // frees memory: no other step reads it
  };

  for (const { part, work } of planParts(steps, sampling.parts ?? [{ start: 0, length: latents }])) {
    for (const { step, blocks } of work) {
      for (let first = 0; first < blocks.length; first += blocksPerRun) {
        await compute(step, blocks.slice(first, first + blocksPerRun));
      }
    }
    const { x } = stateAt(schedule.length);
    if (done === total) return x;
    await sampling.onPart?.(part, x.slice(part.start * width, (part.start + part.length) * width));
  }
  throw new Error('the last part of a sampling has to be the whole clip');
}

/** Runs the step graph on some blocks of step `k`, from the state before it into the state after it. */
async function runBlocks(
  { latent, schedule, memory, guidance, musicGuidance, runStep, signal }: Sampling,
  k: number,
  blocks: readonly Block[],
  before: StepState,
  after: StepState,
): Promise<void> {
  const { time, coefficients } = schedule[k]!;
  const width = latent.layers.length * latent.channels;
  await yieldToEvents(signal);
  const output = await runStep({
    blocks: blocks.length,
    x: gather(before.x, width, blocks, latent.block),
    memory: gather(memory, latent.memory_width, blocks, latent.block),
    valid: validity(blocks, latent.block),
    time,
    guidance,
    musicGuidance,
    coefficients,
  });
  scatter(after.x, width, output.x, blocks, latent.block);
  scatter(after.x0, width, output.x0, blocks, latent.block);
}
