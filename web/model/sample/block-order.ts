/** In which order the blocks of a sampling are computed: all of a step before the next, or outwards from a place. */
import type { Block } from './blocks';

/** Blocks of one step that can be computed together. */
export interface Run {
  readonly step: number;
  readonly blocks: readonly Block[];
}

/** Runs after which the last step is done for `part`; they come in an order in which each finds what it needs. */
export interface PlannedPart {
  readonly runs: readonly Run[];
  readonly part: Block;
}

/**
 * What has to be computed for growing parts of a clip. A block of one step needs the blocks of the step before that
 * lie under it, so with alternating partitions the work under a part is a cone; no block is computed twice, and
 * parts that end with the whole clip compute all blocks whatever the order.
 * @param partitions blocks of each step
 * @param parts in latent frames; each holds the one before
 */
export function planParts(partitions: readonly (readonly Block[])[], parts: readonly Block[]): PlannedPart[] {
  const planned = new Set<Block>();
  return parts.map((part) => {
    const runs: Run[] = [];
    let under = part;
    for (const [step, blocks] of [...partitions.entries()].reverse()) {
      const needed = blocks.filter((block) => overlap(block, under));
      const fresh = needed.filter((block) => !planned.has(block));
      for (const block of fresh) planned.add(block);
      if (fresh.length > 0) runs.unshift({ step, blocks: fresh });
      under = joined(needed);
    }
    return { runs, part };
  });
}

/**
 * Parts of a clip around a place: three blocks, nine, and so on to the whole, as far as what is then left takes long
 * enough for someone to want to see them before.
 * @param place latent frame
 * @param worth whether a part is worth showing, by the share of all block computations that comes after it
 */
export function partsAround(
  partitions: readonly (readonly Block[])[],
  place: number,
  worth: (left: number) => boolean,
): Block[] {
  const blocks = partitions.at(-1) ?? [];
  const found = blocks.findIndex(({ start, length }) => place < start + length);
  const centre = found < 0 ? blocks.length - 1 : found;
  const parts: Block[] = [];
  for (let extent = 1; extent < blocks.length; extent = 3 * extent + 1) {
    parts.push(joined(blocks.slice(Math.max(0, centre - extent), centre + extent + 1)));
  }
  const total = partitions.flat().length;
  let left = total;
  const shown = planParts(partitions, parts).filter(({ runs }) => {
    left -= runs.reduce((sum, run) => sum + run.blocks.length, 0);
    return left > 0 && worth(left / total);
  });
  return [...shown.map(({ part }) => part), joined(blocks)];
}

function overlap(a: Block, b: Block): boolean {
  return a.start < b.start + b.length && b.start < a.start + a.length;
}

/** One block over neighbours that follow each other. */
function joined(blocks: readonly Block[]): Block {
  const start = blocks[0]?.start ?? 0;
  return { start, length: blocks.reduce((sum, { length }) => sum + length, 0) };
}
