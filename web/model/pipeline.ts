import type { MotionClip, SolvedMotion } from '../motion/clip';
import { lockFeet } from '../motion/foot-lock';
import { solve } from '../motion/solve';
import type { Block } from './blocks';
import { type ConditionInput, conditionClip } from './chunks';
import { ModelError } from './error';
import { checkCoarse, checkRequest, type CoarseRequest, type GenerateRequest, prepareInput } from './inputs';
import type { Manifest } from './manifest';
import { noise } from './noise';
import { around, blockAt, blockRuns, worthPreview } from './preview';
import { sample, type Sampling } from './sampler';
import { ddim } from './schedule';
import type { ModelSession } from './session';
import { nextTurn } from './turn';

export type Stage = 'condition' | 'preview' | 'step' | 'decode' | 'solve';

export interface Progress {
  readonly stage: Stage;
  /** Pieces of this stage that are done, of `total`. */
  readonly done: number;
  readonly total: number;
  /** Of the whole generation, 0 to 1. */
  readonly fraction: number;
}

/** The partner, at the leader's size and as long as the leader. */
export interface Made {
  readonly motion: SolvedMotion;
  /** The same with its feet locked, made here because it would hold up the page. */
  readonly locked: SolvedMotion;
}

/** A partner of whom one part is made already, close to what it will be; around it stands what was there before. */
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
  /** Motion frame that someone is looking at: its block is made first and handed to `onPreview`, if that is worth it. */
  readonly at?: number | undefined;
  readonly onPreview?: ((preview: Preview) => void) | undefined;
}

// A minute of dance at a time bounds the memory of the convolutions; sixteen blocks that of attention.
const LATENTS_PER_RUN = 480;
const BLOCKS_PER_RUN = 16;

// Shares of the whole, roughly as measured, so that the bar moves evenly.
const SHARES: Record<Exclude<Stage, 'preview'>, readonly [from: number, to: number]> = {
  condition: [0, 0.04],
  step: [0.04, 0.86],
  decode: [0.86, 0.94],
  solve: [0.94, 1],
};

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

/** What a generation computes: blocks of the whole, blocks of the preview, and the block that the preview is of. */
interface Plan {
  readonly runs: number;
  readonly before: number;
  readonly block: Block | null;
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
   * @throws {ModelError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async generate(request: GenerateRequest, options: GenerateOptions = {}): Promise<GenerateResult> {
    checkRequest(request, this.manifest);
    const { condition, scale } = prepareInput(request, this.manifest);
    const times = [this.now()];
    const memory = await this.#remember(condition, options);
    times.push(this.now());
    const sampling = this.#sampling(request, memory, options);
    const plan = this.#plan(request, sampling.latents, options);
    const every = this.manifest.latent.layers.map(() => 1);
    const shape = (latents: Float32Array): Promise<MotionClip> =>
      this.#decode(request.leader, latents, condition.leader, scale, every, options);
    if (plan.block) {
      const preview = await this.#preview(request, sampling, plan, shape, options);
      options.onPreview?.(preview);
      await nextTurn(options.signal);
    }
    const began = this.now();
    const latents = await sample({
      ...sampling,
      onProgress: tellRuns(options, 'step', plan.before, plan.runs),
    });
    times.push(this.now());
    this.#latents = latents;
    this.#pace = (this.now() - began) / plan.runs;
    const clip = await shape(latents);
    tell(options, 'decode')(1, 1);
    times.push(this.now());
    await nextTurn(options.signal);
    const motion = solve(clip);
    const locked = lockFeet(motion);
    times.push(this.now());
    tell(options, 'solve')(1, 1);
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
   * @throws {ModelError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async coarse(request: CoarseRequest, { signal }: GenerateOptions = {}): Promise<SolvedMotion> {
    checkCoarse(request, this.manifest);
    const { leader, latents } = request;
    const { condition, scale } = prepareInput({ leader, music: null }, this.manifest);
    const layers = this.manifest.latent.layers.map((layer) => (layer === 'coarse' ? 1 : 0));
    const clip = await this.#decode(leader, latents, condition.leader, scale, layers, { signal });
    await nextTurn(signal);
    return solve(clip);
  }

  /** How many blocks the whole takes, and the block that is made before it, if one is. */
  #plan({ steps }: GenerateRequest, latents: number, { at, onPreview }: GenerateOptions): Plan {
    const { latent, diffusion } = this.manifest;
    const count = (frames: number): number =>
      blockRuns(frames, latent.block, steps, diffusion.alternating_phase);
    const runs = count(latents);
    if (at === undefined || !onPreview) return { runs, before: 0, block: null };
    const block = blockAt(latents, latent.block, at / latent.stride);
    const before = count(block.length);
    return worthPreview(before, runs, this.#pace)
      ? { runs, before, block }
      : { runs, before: 0, block: null };
  }

  /** One block sampled for itself: without its neighbours it is not quite what it will be, but it is there soon. */
  async #preview(
    { seed, leader }: GenerateRequest,
    sampling: Sampling,
    { runs, before, block }: Plan,
    shape: (latents: Float32Array) => Promise<MotionClip>,
    options: GenerateOptions,
  ): Promise<Preview> {
    const { latent } = this.manifest;
    const { start, length } = block ?? { start: 0, length: sampling.latents };
    const width = latent.layers.length * latent.channels;
    const remembered = latent.memory_width;
    const made = await sample({
      ...sampling,
      latents: length,
      memory: sampling.memory.subarray(start * remembered, (start + length) * remembered),
      noise: (draw) => noise(seed, length, width, draw, start),
      onProgress: tellRuns(options, 'preview', 0, before + runs),
    });
    const size = sampling.latents * width;
    const earlier = this.#latents?.length === size ? this.#latents : null;
    const clip = await shape(around(made, { start, length }, earlier, sampling.latents, width));
    await nextTurn(options.signal);
    const motion = solve(clip);
    const from = start * latent.stride;
    const to = Math.min(leader.frames, (start + length) * latent.stride);
    return { motion, locked: lockFeet(motion), fresh: { from, to } };
  }

  /** Memory of this leader and song, computed once however often guidance, seed or steps change. */
  async #remember(input: ConditionInput, options: GenerateOptions): Promise<Float32Array> {
    if (this.#memory !== undefined && sameInput(this.#memory.input, input)) {
      tell(options, 'condition')(1, 1);
      return this.#memory.memory;
    }
    const memory = await conditionClip(this.session.condition, input, this.manifest, LATENTS_PER_RUN, {
      signal: options.signal,
      onProgress: tell(options, 'condition'),
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
      noise: (draw) => noise(request.seed, latents, latent.layers.length * latent.channels, draw),
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
    await nextTurn(options.signal);
    const decoded = await this.session.decode({ latents, leader, layers: Float32Array.from(layers) });
    const positions = decoded.slice(0, frames * skeleton.joints.length * 3).map((value) => value / scale);
    if (!positions.every(Number.isFinite)) {
      throw new ModelError(
        'not-finite',
        'The model answered with positions that are not numbers.',
        'Lower the guidance, or choose the processor instead of WebGPU.',
      );
    }
    return { fps, frames, positions };
  }
}

/** Progress of one stage as progress of the whole. */
function tell(
  { onProgress }: GenerateOptions,
  stage: keyof typeof SHARES,
): (done: number, total: number) => void {
  const [from, to] = SHARES[stage];
  return (done, total) => onProgress?.({ stage, done, total, fraction: from + ((to - from) * done) / total });
}

/** Progress of preview or steps, which share the stretch of the steps: `before` blocks were done ahead of `total`. */
function tellRuns(
  { onProgress }: GenerateOptions,
  stage: 'preview' | 'step',
  before: number,
  runs: number,
): (done: number, total: number) => void {
  const [from, to] = SHARES.step;
  const all = before + runs;
  return (done, total) =>
    onProgress?.({ stage, done, total, fraction: from + ((to - from) * (before + done)) / all });
}
