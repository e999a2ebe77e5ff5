import { describe, expect, it } from 'vitest';
import { blocksOf, doneShare } from '../../../../web/ui/timeline/block-row';
import type { Job } from '../../../../web/ui/store/state';

const job = (fraction: number): Job => ({ stage: 'step', fraction });

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

  it('fill one after the other', () => {
    const parts = (fraction: number): number[] =>
      blocks.map((block) => Number(doneShare(block, blocks, job(fraction)).toFixed(3)));
    expect(parts(0)).toEqual([0, 0, 0]);
    expect(parts(0.5)).toEqual([1, 0.25, 0]);
    expect(parts(0.9)).toEqual([1, 1, 0.5]);
    expect(parts(1)).toEqual([1, 1, 1]);
    expect(blocks.map((block) => doneShare(block, blocks, null))).toEqual([0, 0, 0]);
  });
});
