import { yieldToEvents } from '../../common/yield-to-events';
import { avoidCollisions } from '../../motion/contact/collision-avoidance';
import { lockFeet } from '../../motion/contact/foot-lock';
import { solve } from '../../motion/fit/ik';
import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { mostDifferent } from '../../motion/skeleton/difference';
import type { ModelSession } from '../load/session';
import type { Manifest } from '../manifest';
import { stageProgress } from '../progress';
import { blend, coarseAlone, layerGains, neededBranches } from './blend';
import { BranchSampler } from './branch-sampler';
import { decodeClip, type LatentRange, meanLengths } from './decoder';
import {
  checkCoarse,
  checkRequest,
  type CoarseRequest,
  type GenerateRequest,
  type ModelInput,
  prepareInput,
  type SeedsRequest,
} from './inputs';
import type { GenerateOptions, GenerateResult, Preview, SeedsOptions } from './results';

/** Length of the part that is shown before the whole, seconds; it begins half a second before the frame on view. */
const PREVIEW = { before: 0.5, length: 3 };
/** A clip that is not longer than this many parts is shown at once. */
const PREVIEW_WORTH = 2;

/** A dance ready to be decoded. */
interface Blended {
  readonly latents: Float32Array;
  readonly gains: Float32Array;
  readonly bones: Float32Array;
  readonly input: ModelInput;
  readonly leader: MotionClip;
}

/** From a leader and a song to the solved motion of the other dancer, on an open session. */
export class Pipeline {
  readonly #branches: BranchSampler;
  /** Bone lengths by the conditional latents that they were measured on: no weight changes the body. */
  readonly #bones = new WeakMap<Float32Array, Float32Array>();

  /** `now` gives seconds. */
  constructor(
    readonly manifest: Manifest,
    readonly session: ModelSession,
    readonly now: () => number,
  ) {
    this.#branches = new BranchSampler(manifest, session);
  }

  /**
   * Samples the branches that the weights need and are not there yet, blends, decodes and solves. With
   * `options.at` the part around that frame is handed over first.
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async generate(request: GenerateRequest, options: GenerateOptions = {}): Promise<GenerateResult> {
    checkRequest(request, this.manifest);
    const { signal, onProgress, at, onPreview } = options;
    const lap = lapTimer(this.now);
    const blended = await this.#blend(request, options);
    const steps = lap();
    if (onPreview && at !== undefined) {
      const part = await this.#preview(blended, at, signal);
      if (part) onPreview(part);
    }
    const clip = await this.#decode(blended, signal);
    stageProgress(onProgress, 'decode')(1, 1);
    const decode = lap();
    await yieldToEvents(signal);
    const motion = this.#solve(clip, blended.leader);
    const locked = lockFeet(motion);
    stageProgress(onProgress, 'solve')(1, 1);
    return { motion, locked, latents: blended.latents, seconds: { steps, decode, solve: lap() } };
  }

  /**
   * Decodes the coarse layer of a reaction without the fine one.
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async coarse({ leader, latents }: CoarseRequest, { signal }: GenerateOptions = {}): Promise<SolvedMotion> {
    checkCoarse({ leader, latents }, this.manifest);
    const input = prepareInput({ leader, music: null }, this.manifest);
    const gains = coarseAlone(this.manifest.latent);
    const bones = await this.#measureBones(latents, gains, input, signal);
    const clip = await this.#decode({ latents, gains, bones, input, leader }, signal);
    await yieldToEvents(signal);
    return this.#solve(clip, leader);
  }

  /**
   * Samples and decodes the dances of several seeds and finds those that differ most. What was sampled for them is kept
   * for `generate`.
   * @returns `count` of the seeds
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async differingSeeds(
    { request, seeds, count, seconds }: SeedsRequest,
    { signal, onProgress }: SeedsOptions = {},
  ): Promise<number[]> {
    checkRequest(request, this.manifest);
    const start = this.now();
    const dances: Float32Array[] = [];
    for (const seed of seeds) {
      const expected = ((this.now() - start) * (dances.length + 1)) / dances.length;
      if (dances.length >= count && expected > seconds) break;
      const blended = await this.#blend({ ...request, seed }, { signal });
      const { positions } = await this.#decode(blended, signal);
      dances.push(positions);
      onProgress?.(dances.length / seeds.length);
    }
    return mostDifferent(dances, count).map((index) => seeds[index]!);
  }

  async #blend(request: GenerateRequest, { signal, onProgress }: GenerateOptions): Promise<Blended> {
    const { latent } = this.manifest;
    const input = prepareInput(request, this.manifest);
    const wanted = neededBranches(request, latent);
    const branches = await this.#branches.branches(input.condition, request, wanted, {
      signal,
      onCondition: stageProgress(onProgress, 'condition'),
      onStep: stageProgress(onProgress, 'step'),
    });
    return {
      latents: blend(branches, request, latent),
      gains: layerGains(request.guidance, latent),
      bones: await this.#bonesOf(branches.conditional, input, signal),
      input,
      leader: request.leader,
    };
  }

  /** Bone lengths of the conditional latents, metres. */
  async #bonesOf(
    conditional: Float32Array,
    input: ModelInput,
    signal: AbortSignal | undefined,
  ): Promise<Float32Array> {
    const { streams, layers } = this.manifest.latent;
    const gains = new Float32Array(streams.length * layers.length).fill(1);
    const bones =
      this.#bones.get(conditional) ?? (await this.#measureBones(conditional, gains, input, signal));
    this.#bones.set(conditional, bones);
    return bones;
  }

  async #measureBones(
    latents: Float32Array,
    gains: Float32Array,
    { condition }: ModelInput,
    signal: AbortSignal | undefined,
  ): Promise<Float32Array> {
    const joints = this.manifest.skeleton.joints.length;
    const bones = new Float32Array(joints).fill(1); // any: lengths are measured before they are made constant
    const request = { latents, leader: condition.leader, gains, bones };
    const { lengths } = await decodeClip(this.session, this.manifest, request, undefined, signal);
    return meanLengths(lengths, joints);
  }

  /** The part of the dance around a motion frame; null where the whole is there as soon. */
  async #preview(blended: Blended, at: number, signal: AbortSignal | undefined): Promise<Preview | null> {
    const { fps, latent } = this.manifest;
    const { leader } = blended;
    if (leader.frames <= PREVIEW_WORTH * PREVIEW.length * fps) return null;
    const from = Math.min(
      Math.max(0, Math.floor((at - PREVIEW.before * fps) / latent.stride)),
      Math.floor((leader.frames - PREVIEW.length * fps) / latent.stride),
    );
    const end = Math.min(
      from + Math.ceil((PREVIEW.length * fps) / latent.stride),
      leader.frames / latent.stride,
    );
    const range = { start: from, end: Math.floor(end) };
    const clip = await this.#decode(blended, signal, range);
    const fresh = { from: range.start * latent.stride, to: range.end * latent.stride };
    const motion = this.#solve(clip, partOf(leader, fresh.from, fresh.to));
    return { motion, locked: lockFeet(motion), fresh };
  }

  /** Joints at the leader's own size, of the whole clip or of a range of latent frames. */
  async #decode(
    { latents, gains, bones, input, leader }: Blended,
    signal: AbortSignal | undefined,
    range?: LatentRange,
  ): Promise<MotionClip> {
    const { skeleton, latent } = this.manifest;
    const request = { latents, leader: input.condition.leader, gains, bones };
    const { joints } = await decodeClip(this.session, this.manifest, request, range, signal);
    const frames = range ? (range.end - range.start) * latent.stride : leader.frames;
    const positions = joints
      .subarray(0, frames * skeleton.joints.length * 3)
      .map((value) => value / input.scale);
    return { fps: leader.fps, frames, positions };
  }

  /** Fits a skeleton to decoded joints and moves the body out of the leader's. */
  #solve(clip: MotionClip, leader: MotionClip): SolvedMotion {
    return avoidCollisions(solve(clip), leader, this.manifest.quality.penetration);
  }
}

/** Frames `from` to `to` of a clip, the latter excluded. */
function partOf({ fps, positions, frames }: MotionClip, from: number, to: number): MotionClip {
  const width = positions.length / frames;
  return { fps, frames: to - from, positions: positions.subarray(from * width, to * width) };
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
