/** The order of work around a latent frame: every block once, and never before the blocks that it depends on. */
import { describe, expect, it } from 'vitest';
import { type Block, partition } from '../../../../web/model/sample/blocks';
import { partsAround, planParts } from '../../../../web/model/sample/block-order';

const alternating = (latents: number, steps: number): Block[][] =>
  Array.from({ length: steps }, (_, k) => partition(latents, 60, k % 2 === 1));
const always = (): boolean => true;

describe('planParts', () => {
  it.each([0, 100, 450, 899])(
    'computes each block once and after all that it depends on (from frame %s)',
    (frame) => {
      const partitions = alternating(900, 5);
      const done = partitions.map(() => new Set<Block>());
      for (const { work, part } of planParts(partitions, partsAround(partitions, frame, always))) {
        for (const { step, blocks } of work) {
          for (const block of blocks) {
            expect(done[step]?.has(block)).toBe(false);
            const needed = (partitions[step - 1] ?? []).filter(
              (other) => other.start < block.start + block.length && block.start < other.start + other.length,
            );
            expect(needed.every((other) => done[step - 1]?.has(other))).toBe(true);
          }
          for (const block of blocks) done[step]?.add(block);
        }
        const last = (partitions.at(-1) ?? []).filter(
          ({ start, length }) => start < part.start + part.length && part.start < start + length,
        );
        expect(last.every((block) => done.at(-1)?.has(block))).toBe(true);
      }
      expect(done.map((blocks) => blocks.size)).toEqual(partitions.map((blocks) => blocks.length));
    },
  );

  it('needs one more block per earlier step where partitions alternate, and one block per step where they do not', () => {
    const blocks = (partitions: Block[][]): number[] =>
      planParts(partitions, [{ start: 420, length: 60 }])[0]?.work.map((step) => step.blocks.length) ?? [];
    expect(blocks(alternating(900, 5))).toEqual([5, 4, 3, 2, 1]);
    expect(blocks(Array.from({ length: 5 }, () => partition(900, 60, false)))).toEqual([1, 1, 1, 1, 1]);
  });
});

describe('partsAround', () => {
  it('grows to both sides until the whole clip, and stops at its ends', () => {
    expect(partsAround(alternating(900, 5), 450, always)).toEqual([
      { start: 360, length: 180 },
      { start: 180, length: 540 },
      { start: 0, length: 900 },
    ]);
    expect(partsAround(alternating(900, 5), 0, always)[0]).toEqual({ start: 0, length: 120 });
    expect(partsAround(alternating(900, 5), 5000, always)[0]).toEqual({ start: 780, length: 120 });
  });

  it('leaves out parts that are not to be shown, given the share that remains after them', () => {
    const asked: number[] = [];
    const parts = partsAround(alternating(900, 5), 450, (remaining) => {
      asked.push(remaining);
      return remaining > 0.6;
    });
    expect(parts.map(({ length }) => length)).toEqual([180, 900]);
    // The parts need 3 + 4 + 5 + 6 + 7 and 9 + 10 + 11 + 12 + 13 of 77 blocks.
    expect(asked).toEqual([1 - 25 / 77, 1 - 55 / 77]);
  });
});
