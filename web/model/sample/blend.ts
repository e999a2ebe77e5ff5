/** Classifier-free guidance after sampling: the paper's Eq. 9 on sampled latents. */
import type { Manifest } from '../manifest';

type Latent = Pick<Manifest['latent'], 'streams' | 'layers' | 'channels'>;

/** Latents (latents x layers x channels, normalised) of one dance, sampled from the same noise. */
export interface Branches {
  /** Leader and song. */
  readonly conditional: Float32Array;
  /** The leader without a song; null where no weight needs it. */
  readonly silent: Float32Array | null;
  /** Neither; null where no weight needs it. */
  readonly unconditional: Float32Array | null;
  /** Mean coarse layer of the conditional branches of several seeds, latents x channels; null where not needed. */
  readonly mean: Float32Array | null;
}

/** Weights of guidance. */
export interface Weights {
  /** streams x layers, s of Eq. 9. */
  readonly guidance: Float32Array;
  /** Guidance weight m of the music. */
  readonly musicGuidance: number;
  /** How far a seed's coarse layer is from the mean of several seeds: 0 is the mean, 1 the seed as sampled. */
  readonly variety: number;
}

export type NeededBranches = Readonly<Record<'silent' | 'unconditional' | 'mean', boolean>>;

/** Which branches these weights need beside the conditional one. */
export function neededBranches(
  { guidance, musicGuidance, variety }: Weights,
  { layers }: Latent,
): NeededBranches {
  const coarse = guidance.some((weight, i) => i % layers.length === 0 && weight !== 0);
  return { silent: musicGuidance !== 0, unconditional: coarse, mean: variety !== 1 };
}

/**
 * cond + m (cond - silent), in the coarse layer also + s (cond - uncond) + (v - 1)(cond - mean): variety moves the
 * seed's own coarse layer to mean + v (cond - mean). The fine layer's guidance acts where latents are decoded, see
 * `layerGains`.
 * @returns latents x layers x channels
 */
export function blend(
  branches: Branches,
  { guidance, musicGuidance, variety }: Weights,
  latent: Latent,
): Float32Array {
  const out = branches.conditional.slice();
  addMusicGuidance(out, branches, musicGuidance);
  addVariety(out, branches, variety, latent);
  addCoarseGuidance(out, branches, guidance, latent);
  return out;
}

/** m (cond - silent), in all layers. */
function addMusicGuidance(out: Float32Array, { conditional, silent }: Branches, weight: number): void {
  if (!silent || weight === 0) return;
  for (let i = 0; i < out.length; i++) out[i]! += weight * (conditional[i]! - silent[i]!);
}

/** (v - 1)(cond - mean), in the coarse layer, which is the first of each latent. */
function addVariety(
  out: Float32Array,
  { conditional, mean }: Branches,
  variety: number,
  { layers, channels }: Latent,
): void {
  if (!mean || variety === 1) return;
  for (const [i, value] of mean.entries()) {
    const at = Math.floor(i / channels) * layers.length * channels + (i % channels);
    out[at]! += (variety - 1) * (conditional[at]! - value);
  }
}

/** s (cond - uncond), in the coarse layer, with the weight of each stream for its share of the channels. */
function addCoarseGuidance(
  out: Float32Array,
  { conditional, unconditional }: Branches,
  guidance: Float32Array,
  { streams, layers, channels }: Latent,
): void {
  if (!unconditional) return;
  const perStream = channels / streams.length;
  for (let stream = 0; stream < streams.length; stream++) {
    const weight = guidance[stream * layers.length] ?? 0;
    if (weight === 0) continue;
    for (let first = stream * perStream; first < out.length; first += layers.length * channels)
      for (let i = first; i < first + perStream; i++)
        out[i]! += weight * (conditional[i]! - unconditional[i]!);
  }
}

/**
 * Factors of the residual layers, streams x layers: Eq. 9 between a dance with its fine layer and the same dance
 * without it, (1 + s) fine - s 0.
 */
export function layerGains(guidance: Float32Array, { layers }: Latent): Float32Array {
  return guidance.map((weight, i) => (i % layers.length === 0 ? 1 : 1 + weight));
}

/** Factors that leave all layers as they were sampled. */
export function unitGains({ streams, layers }: Latent): Float32Array {
  return new Float32Array(streams.length * layers.length).fill(1);
}

/** Factors that leave the coarse layer alone. */
export function coarseAlone({ streams, layers }: Latent): Float32Array {
  return Float32Array.from(streams.flatMap(() => layers.map((_, layer) => (layer === 0 ? 1 : 0))));
}
