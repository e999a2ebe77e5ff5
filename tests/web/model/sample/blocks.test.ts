import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { gather, partition, scatter, validity } from '../../../../web/model/sample/blocks';

describe('partition', () => {
  it('cuts full blocks and a short last one', () => {
    expect(partition(130, 60)).toEqual([
      { start: 0, length: 60 },
      { start: 60, length: 60 },
      { start: 120, length: 10 },
    ]);
  });

  it('covers every length once and in order', () => {
    for (let latents = 1; latents <= 600; latents++) {
      const blocks = partition(latents, 60);
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

  it('cuts one to ten blocks and all odd tails as Python does', () => {
    const golden = JSON.parse(
      readFileSync(new URL('../../../fixtures/sampling.json', import.meta.url), 'utf8'),
    ) as { block: number; partitions: { latents: number; blocks: number[][] }[] };
    expect(golden.partitions.length).toBeGreaterThan(30);
    for (const { latents, blocks } of golden.partitions)
      expect(partition(latents, golden.block).map(({ start, length }) => [start, length])).toEqual(blocks);
  });
});

describe('gather and scatter', () => {
  it('bring every frame there and back, padded with zeros', () => {
    for (const latents of [1, 3, 5, 6, 7, 9, 15, 31]) {
      const source = Float32Array.from({ length: latents * 2 }, (_, i) => i + 1);
      const blocks = partition(latents, 6);
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
