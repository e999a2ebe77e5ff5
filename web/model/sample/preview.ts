/** Which part of a clip is worth computing before the rest, and what stands around it until the rest is there. */
import type { Block } from './blocks';
import { partitions, type Sampling } from './sampler';
import { partsAround } from './block-order';

/** A run that is over sooner than this needs no preview, seconds. */
const SOON = 0.3;
/** A preview that costs more of the whole than this is not worth waiting for. */
const WORTH = 0.5;
/** Less than this of the whole is not worth drawing a picture before it. */
const LAST = 0.2;

/** What a generation computes, counted in blocks that go through the step graph. */
export interface Plan {
  readonly runs: number;
  /** Blocks of the preview, and the block that it is of. */
  readonly before: number;
  readonly block: Block | null;
  /** Parts of the whole that are shown as they are done; the whole itself is the last. */
  readonly parts: readonly Block[] | undefined;
}

/**
 * The work of a sampling in the order that serves someone who looks at one place.
 * @param place latent frame, null when nobody looks
 * @param pace seconds that one block took in one step before; undefined when it was not measured
 */
export function planWork(sampling: Sampling, place: number | null, pace: number | undefined): Plan {
  const cut = partitions(sampling);
  const runs = cut.flat().length;
  const whole = { runs, before: 0, block: null, parts: undefined };
  if (place === null) return whole;
  const parts = partsAround(cut, place, (left) => worthShowing(left, runs, pace));
  const block = blockAt(sampling.latents, sampling.latent.block, place);
  const before = partitions({ ...sampling, latents: block.length }).flat().length;
  return worthPreview(before, runs, pace) ? { runs, before, block, parts } : { ...whole, parts };
}

/** The block of the plain partition that holds a latent frame; frames outside the clip count as its ends. */
export function blockAt(latents: number, size: number, latent: number): Block {
  const held = Math.min(latents - 1, Math.max(0, Math.floor(latent)));
  const start = held - (held % size);
  return { start, length: Math.min(size, latents - start) };
}

/**
 * Whether showing one block early is worth its cost.
 * @param pace seconds that one block takes in one step, as measured before; undefined when it was not
 */
export function worthPreview(preview: number, whole: number, pace: number | undefined): boolean {
  return preview <= WORTH * whole && (pace === undefined || pace * whole >= SOON);
}

/**
 * Whether a part that is done is worth showing before the whole is.
 * @param left share of the block computations that come after it
 * @param pace as in `worthPreview`
 */
export function worthShowing(left: number, whole: number, pace: number | undefined): boolean {
  return left >= LAST && (pace === undefined || pace * whole * left >= SOON);
}

/**
 * Latents of a whole clip in which one part is new. What the decode graph makes of a part depends on its
 * neighbours and on the clip's statistics, so around it stand the latents of an earlier run; without one the block
 * itself, over and over, which keeps the statistics of a dance where zeros would not.
 * @param block length x width
 * @param earlier latents x width of another run over a clip as long
 */
export function around(
  block: Float32Array,
  { start, length }: Block,
  earlier: Float32Array | null,
  latents: number,
  width: number,
): Float32Array {
  const out = new Float32Array(latents * width);
  if (earlier) out.set(earlier);
  else
    for (let frame = 0; frame < latents; frame++) {
      const from = (((frame - start) % length) + length) % length;
      out.set(block.subarray(from * width, (from + 1) * width), frame * width);
    }
  out.set(block, start * width);
  return out;
}
