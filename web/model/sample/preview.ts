/** Which part of a clip to compute and show first, and what surrounds it until the rest is there. */
import type { Block } from './blocks';
import { blocksByStep, type Sampling } from './sampler';
import { partsAround } from './block-order';

/** Shortest wait that an early picture is worth, seconds. */
const MIN_WAIT = 0.3;
/** Largest cost of a preview, as a share of the block computations of the whole clip. */
const MAX_PREVIEW_SHARE = 0.5;
/** Smallest share of the block computations that must remain after a part for it to be shown. */
const MIN_REMAINING_SHARE = 0.2;

/** What a generation computes; work is counted in blocks that go through the step graph. */
export interface Plan {
  readonly totalBlocks: number;
  /** Extra blocks that the preview costs, 0 without one. */
  readonly previewBlocks: number;
  /** The block that is sampled alone, before all else and once more with its neighbours; null without. */
  readonly preview: Block | null;
  /** Parts that are shown as they are done, the last of them the whole clip; undefined for only that. */
  readonly parts: readonly Block[] | undefined;
}

/**
 * Orders the work of a sampling around the latent frame that is on view.
 * @param frame latent frame, null when none is on view
 * @param secondsPerBlock time of one block in one step, as measured before; undefined when it was not
 */
export function planWork(
  sampling: Sampling,
  frame: number | null,
  secondsPerBlock: number | undefined,
): Plan {
  const steps = blocksByStep(sampling);
  const totalBlocks = steps.flat().length;
  const plain: Plan = { totalBlocks, previewBlocks: 0, preview: null, parts: undefined };
  if (frame === null) return plain;
  const parts = partsAround(steps, frame, (remaining) =>
    shouldShowPart(remaining, totalBlocks, secondsPerBlock),
  );
  const preview = blockAt(sampling.latents, sampling.latent.block, frame);
  const previewBlocks = blocksByStep({ ...sampling, latents: preview.length }).flat().length;
  if (!shouldPreview(previewBlocks, totalBlocks, secondsPerBlock)) return { ...plain, parts };
  // With one partition a block has no neighbours to wait for: alone it is what it will be, so nothing is extra.
  return sampling.alternatingPhase
    ? { totalBlocks, previewBlocks, preview, parts }
    : { ...plain, parts: [preview, ...parts] };
}

/** The block of the unshifted partition that contains a latent frame; frames outside the clip count as its ends. */
export function blockAt(latents: number, size: number, frame: number): Block {
  const inside = Math.min(latents - 1, Math.max(0, Math.floor(frame)));
  const start = inside - (inside % size);
  return { start, length: Math.min(size, latents - start) };
}

/** Whether to sample one block alone first. Parameters as in `Plan` and `planWork`. */
export function shouldPreview(
  previewBlocks: number,
  totalBlocks: number,
  secondsPerBlock: number | undefined,
): boolean {
  if (previewBlocks > MAX_PREVIEW_SHARE * totalBlocks) return false;
  return secondsPerBlock === undefined || secondsPerBlock * totalBlocks >= MIN_WAIT;
}

/**
 * Whether to show a finished part before the whole clip is done.
 * @param remainingShare share of `totalBlocks` that is computed after it
 * @param secondsPerBlock as in `planWork`
 */
export function shouldShowPart(
  remainingShare: number,
  totalBlocks: number,
  secondsPerBlock: number | undefined,
): boolean {
  if (remainingShare < MIN_REMAINING_SHARE) return false;
  return secondsPerBlock === undefined || secondsPerBlock * totalBlocks * remainingShare >= MIN_WAIT;
}

/**
 * Latents of a whole clip of which only one part is sampled so far. The decode graph needs the whole clip, because
 * its output for a part depends on the neighbours and on statistics of the clip. The rest is filled from an earlier
 * sampling; without one by repeating the part, which keeps the statistics of a dance where zeros would not.
 * @param sampled latents of the part, length x width
 * @param earlier latents x width of another sampling of a clip as long, or null
 * @returns latents x width
 */
export function fillAround(
  sampled: Float32Array,
  { start, length }: Block,
  earlier: Float32Array | null,
  latents: number,
  width: number,
): Float32Array {
  const out = new Float32Array(latents * width);
  if (earlier) out.set(earlier);
  else
    for (let frame = 0; frame < latents; frame++) {
      const source = (((frame - start) % length) + length) % length;
      out.set(sampled.subarray(source * width, (source + 1) * width), frame * width);
    }
  out.set(sampled, start * width);
  return out;
}
