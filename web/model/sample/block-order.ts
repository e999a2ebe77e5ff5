/**
 * In which order the blocks of a sampling are computed. Blocks of a step depend on each other only through the step
 * before, so any order that computes those first gives the same result.
 */
import type { Block } from './blocks';

/** Blocks of one step that can be computed together. */
interface StepBlocks {
  readonly step: number;
  readonly blocks: readonly Block[];
}

/** A part of the clip and what remains to be computed for it, in an order in which each input is there. */
interface PlannedPart {
  readonly part: Block;
  readonly work: readonly StepBlocks[];
}

/**
 * Plans growing parts of a clip, each after the one before; no block is computed twice. A block needs the blocks of
 * the step before that overlap it: with one partition just the same block, with alternating partitions one more at
 * every earlier step.
 * @param blocksByStep blocks of each step
 * @param parts in latent frames; each contains the one before
 */
export function planParts(
  blocksByStep: readonly (readonly Block[])[],
  parts: readonly Block[],
): PlannedPart[] {
  const planned = new Set<Block>();
  return parts.map((part) => {
    const work: StepBlocks[] = [];
    let needed = part;
    for (const [step, blocks] of [...blocksByStep.entries()].reverse()) {
      const overlapping = blocks.filter((block) => overlap(block, needed));
      const missing = overlapping.filter((block) => !planned.has(block));
      for (const block of missing) planned.add(block);
      if (missing.length > 0) work.unshift({ step, blocks: missing });
      needed = union(overlapping);
    }
    return { part, work };
  });
}

/**
 * Parts of a clip that grow to both sides of a latent frame: 3 blocks, 9, 27 and so on, last of all the whole clip.
 * @param shouldShow whether to keep a part before the last, given the share of all block computations that remains
 * after it
 */
export function partsAround(
  blocksByStep: readonly (readonly Block[])[],
  frame: number,
  shouldShow: (remainingShare: number) => boolean,
): Block[] {
  const blocks = blocksByStep.at(-1) ?? [];
  const found = blocks.findIndex(({ start, length }) => frame < start + length);
  const centre = found < 0 ? blocks.length - 1 : found;
  const parts: Block[] = [];
  for (let extent = 1; extent < blocks.length; extent = 3 * extent + 1) {
    parts.push(union(blocks.slice(Math.max(0, centre - extent), centre + extent + 1)));
  }
  const total = blocksByStep.flat().length;
  let remaining = total;
  const shown = planParts(blocksByStep, parts).filter(({ work }) => {
    remaining -= work.flatMap((step) => step.blocks).length;
    return remaining > 0 && shouldShow(remaining / total);
  });
  return [...shown.map(({ part }) => part), union(blocks)];
}

function overlap(a: Block, b: Block): boolean {
  return a.start < b.start + b.length && b.start < a.start + a.length;
}

/** One block that covers adjacent blocks. */
function union(blocks: readonly Block[]): Block {
  const start = blocks[0]?.start ?? 0;
  return { start, length: blocks.reduce((sum, { length }) => sum + length, 0) };
}
