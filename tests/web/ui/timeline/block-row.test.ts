import { describe, expect, it } from 'vitest';
import { blocksOf, donePart } from '../../../../web/ui/timeline/block-row';
import type { Job } from '../../../../web/ui/store/state';

const job = (fraction: number, previewed: Job['previewed'] = null): Job => ({
  stage: 'step',
  done: 1,
  total: 4,
  fraction,
  previewed,
});

describe('blocks', () => {
  const blocks = blocksOf(600, 240);
  it('cover the dance, the last one short', () => {
    expect(blocks).toEqual([
      { from: 0, to: 240 },
      { from: 240, to: 480 },
      { from: 480, to: 600 },
    ]);
    expect(blocksOf(0, 240)).toEqual([]);
    expect(blocksOf(100, 0)).toEqual([]);
  });

  it('fill one after the other while only the fraction of the job is known', () => {
    const parts = (fraction: number): number[] =>
      blocks.map((block) => Number(donePart(block, blocks, job(fraction)).to.toFixed(3)));
    expect(parts(0)).toEqual([0, 0, 0]);
    expect(parts(0.5)).toEqual([1, 0.25, 0]);
    expect(parts(0.9)).toEqual([1, 1, 0.5]);
    expect(parts(1)).toEqual([1, 1, 1]);
    expect(blocks.map((block) => donePart(block, blocks, null).to)).toEqual([0, 0, 0]);
  });

  it('fill where new motion is shown already', () => {
    const done = blocks.map((block) => donePart(block, blocks, job(0.1, { from: 300, to: 600 })));
    expect(done).toEqual([
      { from: 0, to: 0 },
      { from: 0.25, to: 1 },
      { from: 0, to: 1 },
    ]);
  });
});
