import { mostDifferent } from '../../motion/skeleton/difference';
import type { ModelSession } from '../load/session';
import type { Manifest } from '../manifest';
import { stageProgress } from '../progress';
import { Assembler, type Dance } from './assemble';
import { blend, coarseAlone, layerGains, neededBranches } from './blend';
import { BranchSampler } from './branch-sampler';
import {
  checkCoarse,
  checkSettings,
  checkSource,
  type CoarseRequest,
  type GenerateRequest,
  type ModelInput,
  prepareInput,
  sameDecoded,
  sameSource,
  type SeedsRequest,
  type Source,
} from './inputs';
import { frameAt, type Playhead } from './playhead';
import type { GeneratedMotion, GenerateOptions, GenerateResult, Preview, SeedsOptions } from './results';

/** Length of the part that is shown before the whole, and how much of it lies before the frame on view, seconds. */
const PREVIEW = { length: 2.5, before: 0.3 };
/** A clip that is not longer than this many parts is made at once. */
const PREVIEW_WORTH = 2;

/** A dance, and how far its leader is from those of training. */
interface SampledDance extends Dance {
  readonly unfamiliarity: number;
}

/** From a leader and a song to the solved motion of the other dancer, on an open session. */
export class Pipeline {
  readonly #branches: BranchSampler;
  readonly #assembler: Assembler;
  /** The last source, as the graphs take it. */
  #prepared: { readonly source: Source; readonly input: ModelInput } | undefined;
  /** The request that was answered last, and its dance. */
  #last: { readonly request: GenerateRequest; readonly dance: SampledDance } | undefined;

  /** `now` gives seconds since 1970. */
  constructor(
    readonly manifest: Manifest,
    session: ModelSession,
    readonly now: () => number,
  ) {
    this.#branches = new BranchSampler(manifest, session);
    this.#assembler = new Assembler(manifest, session);
  }

  /**
   * Samples the branches that the weights need and are not there yet, blends, decodes and solves; where only settings of
   * solving differ from the request before, it only solves. With `options.playhead` the part that is on view is handed over
   * first.
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async generate(request: GenerateRequest, options: GenerateOptions = {}): Promise<GenerateResult> {
    const { signal, playhead, onPreview } = options;
    const lap = lapTimer(this.now);
    const known = this.#sampled(request);
    const dance = known ?? (await this.#blend(request, options));
    this.#last = { request, dance };
    const seconds = { steps: lap(), decode: 0, solve: 0 };
    if (onPreview && playhead && !known) {
      const part = await this.#preview(dance, playhead);
      if (part) await onPreview(part);
      signal?.throwIfAborted();
    }
    lap();
    const { motion, locked } = await this.#assembler.whole(dance, signal, () => {
      seconds.decode = lap();
    });
    seconds.solve = lap();
    // A result's arrays are given away, the dance is kept.
    return { motion, locked, latents: dance.latents.slice(), unfamiliarity: dance.unfamiliarity, seconds };
  }

  /**
   * Decodes the coarse layer of a reaction without the fine one.
   * @throws {AppError} `bad-request` or `not-finite`
   * @throws the signal's reason
   */
  async coarse(request: CoarseRequest, { signal }: GenerateOptions = {}): Promise<GeneratedMotion> {
    checkCoarse(request, this.manifest);
    const dance = {
      ...request,
      gains: coarseAlone(this.manifest.latent),
      input: prepareInput(request, this.manifest),
    };
    return this.#assembler.beside(dance, signal);
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
    const start = this.now();
    const dances: Float32Array[] = [];
    for (const seed of seeds) {
      const expected = ((this.now() - start) * (dances.length + 1)) / dances.length;
      if (dances.length >= count && expected > seconds) break;
      const dance = await this.#blend(
        { ...request, seed },
        { signal, onProgress: ({ fraction }) => onProgress?.((dances.length + fraction) / seeds.length) },
      );
      const { positions } = await this.#assembler.decode(dance, { signal });
      dances.push(positions);
      onProgress?.(dances.length / seeds.length);
    }
    return mostDifferent(dances, count).map((index) => seeds[index]!);
  }

  async #blend(request: GenerateRequest, { signal, onProgress }: GenerateOptions): Promise<SampledDance> {
    const { latent } = this.manifest;
    checkSettings(request, this.manifest);
    const input = this.#inputOf(request);
    const wanted = neededBranches(request, latent);
    const branches = await this.#branches.branches(input.condition, request.seed, wanted, {
      signal,
      onCondition: stageProgress(onProgress, 'condition'),
      onStep: stageProgress(onProgress, 'step'),
    });
    const { leader, role, height, holdHands } = request;
    return {
      latents: blend(branches, request, latent),
      gains: layerGains(request.guidance, latent),
      input,
      leader,
      role,
      height,
      holdHands,
      unfamiliarity: branches.unfamiliarity,
    };
  }

  /** The dance that was answered last, solved as it is asked for, where nothing else has changed. */
  #sampled(request: GenerateRequest): SampledDance | null {
    if (!this.#last || !sameDecoded(this.#last.request, request)) return null;
    checkSettings(request, this.manifest);
    return { ...this.#last.dance, height: request.height, holdHands: request.holdHands };
  }

  /** The source as the graphs take it; made once while the same objects are asked for. */
  #inputOf({ leader, fitted, music, role }: Source): ModelInput {
    const source = { leader, fitted, music, role };
    if (!this.#prepared || !sameSource(this.#prepared.source, source)) {
      checkSource(source, this.manifest);
      this.#prepared = { source, input: prepareInput(source, this.manifest) };
    }
    return this.#prepared.input;
  }

  /** The part of the dance that is on view; null where the whole is there as soon. */
  async #preview(dance: Dance, playhead: Playhead): Promise<Preview | null> {
    const { fps, frames } = dance.leader;
    const length = PREVIEW.length * fps;
    if (frames <= PREVIEW_WORTH * length) return null;
    const from = Math.min(frames - length, frameAt(playhead, this.now()) - PREVIEW.before * fps);
    return this.#assembler.part(dance, from, length);
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
