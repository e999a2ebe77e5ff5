/** The order of work around a place: every block once, and never before what it needs. */
import { describe, expect, it } from 'vitest';
import { type Block, partition } from '../../../../web/model/sample/blocks';
import { partsAround, planParts } from '../../../../web/model/sample/block-order';

const cut = (latents: number, steps: number): Block[][] =>
  Array.from({ length: steps }, (_, k) => partition(latents, 60, k % 2 === 1));
const always = (): boolean => true;

describe('planParts', () => {
  it.each([0, 100, 450, 899])(
    'compute each block once and after all that lie under it (from %s)',
    (place) => {
      const partitions = cut(900, 5);
      const done = partitions.map(() => new Set<Block>());
      for (const { runs, part } of planParts(partitions, partsAround(partitions, place, always))) {
        for (const { step, blocks } of runs) {
          for (const block of blocks) {
            expect(done[step]?.has(block)).toBe(false);
            const under = (partitions[step - 1] ?? []).filter(
              (below) => below.start < block.start + block.length && block.start < below.start + below.length,
            );
            expect(under.every((below) => done[step - 1]?.has(below))).toBe(true);
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

  it('are cones where blocks alternate, and columns where they do not', () => {
    const blocks = (partitions: Block[][]): number[] =>
      planParts(partitions, [{ start: 420, length: 60 }])[0]?.runs.map((run) => run.blocks.length) ?? [];
    expect(blocks(cut(900, 5))).toEqual([5, 4, 3, 2, 1]);
    expect(blocks(Array.from({ length: 5 }, () => partition(900, 60, false)))).toEqual([1, 1, 1, 1, 1]);
  });
});

describe('partsAround', () => {
  it('grows to both sides until the whole clip, and stops at its ends', () => {
    expect(partsAround(cut(900, 5), 450, always)).toEqual([
      { start: 360, length: 180 },
      { start: 180, length: 540 },
      { start: 0, length: 900 },
    ]);
    expect(partsAround(cut(900, 5), 0, always)[0]).toEqual({ start: 0, length: 120 });
    expect(partsAround(cut(900, 5), 5000, always)[0]).toEqual({ start: 780, length: 120 });
  });

  it('leaves out what is not worth showing, judged by what is left after it', () => {
    const asked: number[] = [];
    const parts = partsAround(cut(900, 5), 450, (left) => {
      asked.push(left);
      return left > 0.6;
    });
    expect(parts.map(({ length }) => length)).toEqual([180, 900]);
    // Cones of 3 + 4 + 5 + 6 + 7 and 9 + 10 + 11 + 12 + 13 of 77 blocks.
    expect(asked).toEqual([1 - 25 / 77, 1 - 55 / 77]);
  });
});
