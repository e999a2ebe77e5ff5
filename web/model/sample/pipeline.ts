import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { lockFeet } from '../../motion/contact/foot-lock';
import { avoidCollisions } from '../../motion/contact/collision-avoidance';
import { solve } from '../../motion/fit/ik';
import type { Block } from './blocks';
import { conditionClip } from './condition';
import { AppError } from '../../common/error';
import type { ConditionInput } from './graphs';
import {
  checkCoarse,
  checkRequest,
  type CoarseRequest,
  type GenerateRequest,
  type ModelInput,
  prepareInput,
} from './inputs';
import type { Manifest } from '../manifest';
import { noise } from './noise';
import { fillAround, type Plan, planWork } from './preview';
import { blockProgress, stageProgress } from '../progress';
import type { GenerateOptions, GenerateResult, Preview } from './results';
import { sample, type Sampling } from './sampler';
import { ddim } from './schedule';
import type { ModelSession } from '../load/session';
import { yieldToEvents } from '../../common/yield-to-events';

/** A minute of dance at a time bounds the memory of the condition graph's convolutions. */
const LATENTS_PER_CHUNK = 480;
/** Bounds the memory of attention in the step graph. */
const BLOCKS_PER_RUN = 16;

/** From a leader and a song to the solved motion of the other dancer, on an open session. */
export class Pipeline {
  /** Input and output of the last run of the condition graph. */
  #condition: { input: ConditionInput; memory: Float32Array } | undefined;
  /** Latents of the last generation. */
  #latents: Float32Array | undefined;
  /** Time of one block in one step of that generation. */
  #secondsPerBlock: number | undefined;

  /** `now` gives seconds. */
  constructor(
    readonly manifest: Manifest,
    readonly session: ModelSession,
    readonly now: () => number,
  ) {}

  /**
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async generate(request: GenerateRequest, options: GenerateOptions = {}): Promise<GenerateResult> {
    checkRequest(request, this.manifest);
    const { leader } = request;
    const { signal, onProgress } = options;
    const input = prepareInput(request, this.manifest);
    const lap = lapTimer(this.now);
    const memory = await this.#conditionMemory(input.condition, options);
    const condition = lap();
    const latents = await this.#sample(request, input, this.#sampling(request, memory, options), options);
    const steps = lap();
    const clip = await this.#decode(leader, input, latents, this.#allLayers(), signal);
    stageProgress(onProgress, 'decode')(1, 1);
    const decode = lap();
    await yieldToEvents(signal);
    const motion = this.#solve(clip, leader);
    const locked = lockFeet(motion);
    stageProgress(onProgress, 'solve')(1, 1);
    return {
      motion,
      locked,
      latents: latents.slice(), // transferred to the page, while the pipeline keeps its own for the next preview
      seconds: { condition, steps, decode, solve: lap() },
    };
  }

  /**
   * Decodes the coarse layer of a reaction without the fine one.
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async coarse(request: CoarseRequest, { signal }: GenerateOptions = {}): Promise<SolvedMotion> {
    checkCoarse(request, this.manifest);
    const { leader, latents } = request;
    const input = prepareInput({ leader, music: null }, this.manifest);
    const layers = this.manifest.latent.layers.map((layer) => (layer === 'coarse' ? 1 : 0));
    const clip = await this.#decode(leader, input, latents, layers, signal);
    await yieldToEvents(signal);
    return this.#solve(clip, leader);
  }

  /** Memory of this leader and song, computed once however often guidance, seed or steps change. */
  async #conditionMemory(
    input: ConditionInput,
    { signal, onProgress }: GenerateOptions,
  ): Promise<Float32Array> {
    const listener = stageProgress(onProgress, 'condition');
    if (this.#condition !== undefined && sameInput(this.#condition.input, input)) {
      listener(1, 1);
      return this.#condition.memory;
    }
    const memory = await conditionClip(this.session.condition, input, this.manifest, LATENTS_PER_CHUNK, {
      signal,
      onProgress: listener,
    });
    this.#condition = { input, memory };
    return memory;
  }

  #sampling(request: GenerateRequest, memory: Float32Array, { signal }: GenerateOptions): Sampling {
    const { latent, diffusion } = this.manifest;
    const latents = memory.length / latent.memory_width;
    return {
      latent,
      alternatingPhase: diffusion.alternating_phase,
      schedule: ddim(diffusion, request.steps),
      latents,
      memory,
      guidance: request.guidance,
      musicGuidance: request.musicGuidance,
      noise: noise(request.seed, latents, this.#width),
      runStep: this.session.step,
      blocksPerRun: BLOCKS_PER_RUN,
      signal,
    };
  }

  /** Samples the latents of the whole clip; where a frame is on view, hands over previews on the way. */
  async #sample(
    request: GenerateRequest,
    input: ModelInput,
    sampling: Sampling,
    options: GenerateOptions,
  ): Promise<Float32Array> {
    const { at, onPreview, onProgress, signal } = options;
    const frame = onPreview && at !== undefined ? at / this.manifest.latent.stride : null;
    const plan = planWork(sampling, frame, this.#secondsPerBlock);
    const onPart = async (part: Block, latents: Float32Array): Promise<void> => {
      onPreview?.(await this.#preview(part, latents, sampling.latents, request.leader, input, signal));
      await yieldToEvents(signal);
    };
    if (plan.preview) {
      await onPart(
        plan.preview,
        await this.#sampleAlone(plan.preview, request.seed, sampling, plan, options),
      );
    }
    const { previewBlocks, totalBlocks, parts } = plan;
    const began = this.now();
    const latents = await sample({
      ...sampling,
      parts,
      onPart,
      onProgress: blockProgress(onProgress, 'step', previewBlocks, previewBlocks + totalBlocks),
    });
    this.#secondsPerBlock = (this.now() - began) / totalBlocks;
    this.#latents = latents;
    return latents;
  }

  /** Latents of one block sampled without its neighbours: near to the final ones, and soon there. */
  #sampleAlone(
    { start, length }: Block,
    seed: number,
    sampling: Sampling,
    { previewBlocks, totalBlocks }: Plan,
    { onProgress }: GenerateOptions,
  ): Promise<Float32Array> {
    const { memory_width: memoryWidth } = this.manifest.latent;
    return sample({
      ...sampling,
      latents: length,
      memory: sampling.memory.subarray(start * memoryWidth, (start + length) * memoryWidth),
      noise: noise(seed, length, this.#width, start),
      onProgress: blockProgress(onProgress, 'preview', 0, previewBlocks + totalBlocks),
    });
  }

  /**
   * The dancer with one new part.
   * @param sampled latents of the part
   * @param latents latent frames of the whole clip
   */
  async #preview(
    part: Block,
    sampled: Float32Array,
    latents: number,
    leader: MotionClip,
    input: ModelInput,
    signal: AbortSignal | undefined,
  ): Promise<Preview> {
    const { stride } = this.manifest.latent;
    const earlier = this.#latents?.length === latents * this.#width ? this.#latents : null;
    const filled = fillAround(sampled, part, earlier, latents, this.#width);
    const clip = await this.#decode(leader, input, filled, this.#allLayers(), signal);
    await yieldToEvents(signal);
    const motion = this.#solve(clip, leader);
    const from = part.start * stride;
    const to = Math.min(clip.frames, (part.start + part.length) * stride);
    return { motion, locked: lockFeet(motion), fresh: { from, to } };
  }

  /**
   * Joints at the leader's own size and length.
   * @param layers one multiplier per residual layer
   */
  async #decode(
    { fps, frames }: MotionClip,
    { condition, scale }: ModelInput,
    latents: Float32Array,
    layers: readonly number[],
    signal: AbortSignal | undefined,
  ): Promise<MotionClip> {
    const { skeleton } = this.manifest;
    await yieldToEvents(signal);
    const decoded = await this.session.decode({
      latents,
      leader: condition.leader,
      layers: Float32Array.from(layers),
    });
    const positions = decoded.slice(0, frames * skeleton.joints.length * 3).map((value) => value / scale);
    if (!positions.every(Number.isFinite)) {
      throw new AppError(
        'not-finite',
        'The model answered with positions that are not numbers.',
        'Lower the guidance, or choose the processor instead of WebGPU.',
      );
    }
    return { fps, frames, positions };
  }

  /** Fits a skeleton to decoded joints and moves the body out of the leader's. */
  #solve(clip: MotionClip, leader: MotionClip): SolvedMotion {
    return avoidCollisions(solve(clip), leader, this.manifest.quality.penetration);
  }

  /** Numbers of one latent frame: layers x channels. */
  get #width(): number {
    return this.manifest.latent.layers.length * this.manifest.latent.channels;
  }

  #allLayers(): number[] {
    return this.manifest.latent.layers.map(() => 1);
  }
}

/** Returns a function that gives the seconds since its last call, or since this one. */
function lapTimer(now: () => number): () => number {
  let last = now();
  return () => {
    const before = last;
    last = now();
    return last - before;
  };
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
