import type { MotionClip, SolvedMotion } from '../motion/clip';
import { solve } from '../motion/solve';
import { type ConditionInput, conditionClip } from './chunks';
import { ModelError } from './error';
import { checkRequest, type GenerateRequest, prepareInput } from './inputs';
import type { Manifest } from './manifest';
import { noise } from './noise';
import { sample } from './sampler';
import { ddim } from './schedule';
import type { ModelSession } from './session';
import { nextTurn } from './turn';

export type Stage = 'condition' | 'step' | 'decode' | 'solve';

export interface Progress {
  readonly stage: Stage;
  /** Pieces of this stage that are done, of `total`. */
  readonly done: number;
  readonly total: number;
  /** Of the whole generation, 0 to 1. */
  readonly fraction: number;
}

export interface GenerateResult {
  /** The partner, at the leader's size and as long as the leader. */
  readonly motion: SolvedMotion;
  /** Time of each stage; `condition` is near 0 when the last memory serves again. */
  readonly seconds: Readonly<Record<'condition' | 'steps' | 'decode' | 'solve', number>>;
}

export interface GenerateOptions {
  /** Stops the work before the next graph run; the promise is then rejected with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((progress: Progress) => void) | undefined;
}

// A minute of dance at a time bounds the memory of the convolutions; sixteen blocks that of attention.
const LATENTS_PER_RUN = 480;
const BLOCKS_PER_RUN = 16;

// Shares of the whole, roughly as measured, so that the bar moves evenly.
const SHARES: Record<Stage, readonly [from: number, to: number]> = {
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

/** From a leader and a song to the partner's solved motion, on an open session. */
export class Pipeline {
  #memory: { input: ConditionInput; memory: Float32Array } | undefined;

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
    const latents = await this.#sample(request, memory, options);
    times.push(this.now());
    const clip = await this.#decode(request.leader, latents, condition.leader, scale, options);
    times.push(this.now());
    await nextTurn(options.signal);
    const motion = solve(clip);
    times.push(this.now());
    tell(options, 'solve')(1, 1);
    const [conditioned = 0, steps = 0, decoded = 0, solved = 0] = times
      .slice(1)
      .map((time, i) => time - (times[i] ?? 0));
    return { motion, seconds: { condition: conditioned, steps, decode: decoded, solve: solved } };
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

  #sample(request: GenerateRequest, memory: Float32Array, options: GenerateOptions): Promise<Float32Array> {
    const { latent, diffusion } = this.manifest;
    const latents = memory.length / latent.memory_width;
    return sample({
      latent,
      alternatingPhase: diffusion.alternating_phase,
      schedule: ddim(diffusion, request.steps),
      latents,
      memory,
      guidance: request.guidance,
      noise: (draw) => noise(request.seed, latents, latent.layers.length * latent.channels, draw),
      runStep: this.session.step,
      blocksPerRun: BLOCKS_PER_RUN,
      signal: options.signal,
      onProgress: tell(options, 'step'),
    });
  }

  /** Joints of the leader's own size and length. */
  async #decode(
    { fps, frames }: MotionClip,
    latents: Float32Array,
    leader: Float32Array,
    scale: number,
    options: GenerateOptions,
  ): Promise<MotionClip> {
    const { latent, skeleton } = this.manifest;
    await nextTurn(options.signal);
    const layers = new Float32Array(latent.layers.length).fill(1);
    const decoded = await this.session.decode({ latents, leader, layers });
    tell(options, 'decode')(1, 1);
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
function tell({ onProgress }: GenerateOptions, stage: Stage): (done: number, total: number) => void {
  const [from, to] = SHARES[stage];
  return (done, total) => onProgress?.({ stage, done, total, fraction: from + ((to - from) * done) / total });
}
