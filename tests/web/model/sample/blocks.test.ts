import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { gather, partition, scatter, validity } from '../../../../web/model/sample/blocks';

describe('partition', () => {
  it('cuts full blocks and a short last one', () => {
    expect(partition(130, 60, false)).toEqual([
      { start: 0, length: 60 },
      { start: 60, length: 60 },
      { start: 120, length: 10 },
    ]);
  });

  it('begins a shifted partition with half a block', () => {
    expect(partition(130, 60, true)).toEqual([
      { start: 0, length: 30 },
      { start: 30, length: 60 },
      { start: 90, length: 40 },
    ]);
    expect(partition(30, 60, true)).toEqual([{ start: 0, length: 30 }]);
    expect(partition(7, 60, true)).toEqual([{ start: 0, length: 7 }]);
  });

  it.each([false, true])('covers every length once and in order (shifted: %s)', (shifted) => {
    for (let latents = 1; latents <= 600; latents++) {
      const blocks = partition(latents, 60, shifted);
      let next = 0;
      for (const { start, length } of blocks) {
        expect(start).toBe(next);
        expect(length).toBeGreaterThan(0);
        expect(length).toBeLessThanOrEqual(60);
        next += length;
      }
      expect(next).toBe(latents);
    }
  });

  it('never puts two boundaries of the two partitions on the same frame', () => {
    const ends = (shifted: boolean): number[] =>
      partition(1000, 60, shifted)
        .slice(1)
        .map(({ start }) => start);
    expect(ends(false).filter((start) => ends(true).includes(start))).toEqual([]);
  });
});

describe('partition, as in Python', () => {
  const golden = JSON.parse(
    readFileSync(new URL('../../../fixtures/sampling.json', import.meta.url), 'utf8'),
  ) as { block: number; partitions: { latents: number; plain: number[][]; shifted: number[][] }[] };

  it('cuts one to ten blocks and all odd tails alike', () => {
    expect(golden.partitions.length).toBeGreaterThan(50);
    for (const { latents, plain, shifted } of golden.partitions) {
      const pairs = (odd: boolean): number[][] =>
        partition(latents, golden.block, odd).map(({ start, length }) => [start, length]);
      expect(pairs(false)).toEqual(plain);
      expect(pairs(true)).toEqual(shifted);
    }
  });
});

describe('gather and scatter', () => {
  it.each([false, true])('bring every frame there and back, padded with zeros (shifted: %s)', (shifted) => {
    for (const latents of [1, 3, 5, 6, 7, 9, 15, 31]) {
      const source = Float32Array.from({ length: latents * 2 }, (_, i) => i + 1);
      const blocks = partition(latents, 6, shifted);
      const packed = gather(source, 2, blocks, 6);
      expect(packed).toHaveLength(blocks.length * 12);
      const valid = validity(blocks, 6);
      expect(valid.reduce((sum, v) => sum + v, 0)).toBe(latents);
      packed.forEach((value, i) => expect(value !== 0).toBe(valid[Math.floor(i / 2)] === 1));
      const back = new Float32Array(source.length);
      scatter(back, 2, packed, blocks, 6);
      expect(back).toEqual(source);
    }
  });
});
