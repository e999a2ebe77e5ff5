import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { lockFeet } from '../../motion/contact/foot-lock';
import { avoidCollisions } from '../../motion/contact/collision-avoidance';
import { solve } from '../../motion/fit/ik';
import type { Block } from './blocks';
import { type ConditionInput, conditionClip } from './chunks';
import { AppError } from '../../common/error';
import { checkCoarse, checkRequest, type CoarseRequest, type GenerateRequest, prepareInput } from './inputs';
import type { Manifest } from '../manifest';
import { noise } from './noise';
import { around, type Plan, planWork } from './preview';
import { type Progress, tell, tellRuns } from '../progress';
import { sample, type Sampling } from './sampler';
import { ddim } from './schedule';
import type { ModelSession } from '../load/session';
import { yieldToEvents } from '../../common/yield-to-events';

/** The partner, at the leader's size and as long as the leader. */
export interface Made {
  readonly motion: SolvedMotion;
  /** The same with its feet locked, made here because it would hold up the page. */
  readonly locked: SolvedMotion;
}

/** A partner of whom one part is made already; around it stands what was there before. */
export interface Preview extends Made {
  /** Motion frames that are new, `to` excluded. */
  readonly fresh: { readonly from: number; readonly to: number };
}

export interface GenerateResult extends Made {
  /** What it was decoded from: latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  /** Time of each stage; `condition` is near 0 when the last memory serves again. */
  readonly seconds: Readonly<Record<'condition' | 'steps' | 'decode' | 'solve', number>>;
}

export interface GenerateOptions {
  /** Stops the work before the next graph run; the promise is then rejected with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((progress: Progress) => void) | undefined;
  /**
   * Motion frame that someone is looking at: its block is made first and handed to `onPreview`, then growing parts
   * around it, as far as each is worth it.
   */
  readonly at?: number | undefined;
  readonly onPreview?: ((preview: Preview) => void) | undefined;
}

// A minute of dance at a time bounds the memory of the convolutions; sixteen blocks that of attention.
const LATENTS_PER_RUN = 480;
const BLOCKS_PER_RUN = 16;

function equal(a: Float32Array, b: Float32Array): boolean {
  return a.length === b.length && a.every((value, i) => value === b[i]);
}

function sameInput(a: ConditionInput, b: ConditionInput): boolean {
  return (
    a.role === b.role &&
    equal(a.leader, b.leader) &&
    equal(a.musicValid, b.musicValid) &&
    equal(a.music, b.music)
  );
}

/** From a leader and a song to the partner's solved motion, on an open session. */
export class Pipeline {
  #memory: { input: ConditionInput; memory: Float32Array } | undefined;
  /** Latents of the last whole run. */
  #latents: Float32Array | undefined;
  /** Seconds that one block took in one step of that run. */
  #pace: number | undefined;

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
    const { condition, scale } = prepareInput(request, this.manifest);
    const times = [this.now()];
    const memory = await this.#remember(condition, options);
    times.push(this.now());
    const sampling = this.#sampling(request, memory, options);
    const place =
      options.onPreview && options.at !== undefined ? options.at / this.manifest.latent.stride : null;
    const plan = planWork(sampling, place, this.#pace);
    const every = this.manifest.latent.layers.map(() => 1);
    const shape = (latents: Float32Array): Promise<MotionClip> =>
      this.#decode(request.leader, latents, condition.leader, scale, every, options);
    const show = async (part: Block, made: Float32Array): Promise<void> => {
      options.onPreview?.(await this.#early(part, made, sampling, request.leader, shape, options));
      await yieldToEvents(options.signal);
    };
    if (plan.block)
      await show(plan.block, await this.#preview(request.seed, plan.block, sampling, plan, options));
    const began = this.now();
    const latents = await sample({
      ...sampling,
      parts: plan.parts,
      onPart: show,
      onProgress: tellRuns(options.onProgress, 'step', plan.before, plan.runs),
    });
    times.push(this.now());
    this.#latents = latents;
    this.#pace = (this.now() - began) / plan.runs;
    const clip = await shape(latents);
    tell(options.onProgress, 'decode')(1, 1);
    times.push(this.now());
    await yieldToEvents(options.signal);
    const motion = this.#solve(clip, request.leader);
    const locked = lockFeet(motion);
    times.push(this.now());
    tell(options.onProgress, 'solve')(1, 1);
    const [conditioned = 0, steps = 0, decoded = 0, solved = 0] = times
      .slice(1)
      .map((time, i) => time - (times[i] ?? 0));
    return {
      motion,
      locked,
      latents: latents.slice(), // given away, while these stay for the next preview
      seconds: { condition: conditioned, steps, decode: decoded, solve: solved },
    };
  }

  /**
   * The partner that the coarse layer alone says, solved as the whole partner is.
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async coarse(request: CoarseRequest, { signal }: GenerateOptions = {}): Promise<SolvedMotion> {
    checkCoarse(request, this.manifest);
    const { leader, latents } = request;
    const { condition, scale } = prepareInput({ leader, music: null }, this.manifest);
    const layers = this.manifest.latent.layers.map((layer) => (layer === 'coarse' ? 1 : 0));
    const clip = await this.#decode(leader, latents, condition.leader, scale, layers, { signal });
    await yieldToEvents(signal);
    return this.#solve(clip, leader);
  }

  /** The decoded partner as a body of its own beside the leader. */
  #solve(clip: MotionClip, leader: MotionClip): SolvedMotion {
    return avoidCollisions(solve(clip), leader, this.manifest.quality.penetration);
  }

  /** Latents of one block sampled for itself: without its neighbours it is not quite what it will be, but soon there. */
  #preview(
    seed: number,
    { start, length }: Block,
    sampling: Sampling,
    { runs, before }: Plan,
    { onProgress }: GenerateOptions,
  ): Promise<Float32Array> {
    const { latent } = this.manifest;
    const width = latent.layers.length * latent.channels;
    const remembered = latent.memory_width;
    return sample({
      ...sampling,
      latents: length,
      memory: sampling.memory.subarray(start * remembered, (start + length) * remembered),
      noise: noise(seed, length, width, start),
      onProgress: tellRuns(onProgress, 'preview', 0, before + runs),
    });
  }

  /** The partner of whom a part is new. */
  async #early(
    part: Block,
    made: Float32Array,
    { latents }: Sampling,
    leader: MotionClip,
    shape: (latents: Float32Array) => Promise<MotionClip>,
    { signal }: GenerateOptions,
  ): Promise<Preview> {
    const { latent } = this.manifest;
    const width = latent.layers.length * latent.channels;
    const earlier = this.#latents?.length === latents * width ? this.#latents : null;
    const clip = await shape(around(made, part, earlier, latents, width));
    await yieldToEvents(signal);
    const motion = this.#solve(clip, leader);
    const from = part.start * latent.stride;
    const to = Math.min(clip.frames, (part.start + part.length) * latent.stride);
    return { motion, locked: lockFeet(motion), fresh: { from, to } };
  }

  /** Memory of this leader and song, computed once however often guidance, seed or steps change. */
  async #remember(input: ConditionInput, options: GenerateOptions): Promise<Float32Array> {
    if (this.#memory !== undefined && sameInput(this.#memory.input, input)) {
      tell(options.onProgress, 'condition')(1, 1);
      return this.#memory.memory;
    }
    const memory = await conditionClip(this.session.condition, input, this.manifest, LATENTS_PER_RUN, {
      signal: options.signal,
      onProgress: tell(options.onProgress, 'condition'),
    });
    this.#memory = { input, memory };
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
      noise: noise(request.seed, latents, latent.layers.length * latent.channels),
      runStep: this.session.step,
      blocksPerRun: BLOCKS_PER_RUN,
      signal,
    };
  }

  /** Joints of the leader's own size and length; `layers` holds one multiplier per residual layer. */
  async #decode(
    { fps, frames }: MotionClip,
    latents: Float32Array,
    leader: Float32Array,
    scale: number,
    layers: readonly number[],
    options: GenerateOptions,
  ): Promise<MotionClip> {
    const { skeleton } = this.manifest;
    await yieldToEvents(options.signal);
    const decoded = await this.session.decode({ latents, leader, layers: Float32Array.from(layers) });
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
}
