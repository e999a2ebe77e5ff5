import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { noise, philox } from '../../../../web/model/sample/noise';

interface Case {
  seed: number;
  frames: number;
  channels: number;
  draw: number;
  start: number;
  values: number[];
}
const golden = JSON.parse(readFileSync(new URL('../../../fixtures/noise.json', import.meta.url), 'utf8')) as {
  cases: Case[];
};

describe('noise', () => {
  it('gives the answers published for Philox4x32-10', () => {
    expect(philox([0, 0, 0, 0], [0, 0])).toEqual([0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8]);
    const ones = 0xffffffff;
    expect(philox([ones, ones, ones, ones], [ones, ones])).toEqual([
      0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd,
    ]);
    expect(philox([0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344], [0xa4093822, 0x299f31d0])).toEqual([
      0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1,
    ]);
  });

  it.each(golden.cases)('agrees with Python: seed $seed, from frame $start', (sample) => {
    const values = noise(sample.seed, sample.frames, sample.channels, sample.start);
    expect(values.length).toBe(sample.values.length);
    let worst = 0;
    values.forEach((value, i) => (worst = Math.max(worst, Math.abs(value - (sample.values[i] ?? NaN)))));
    expect(worst).toBeLessThan(1e-6);
  });

  it('gives a frame the same numbers in any range', () => {
    const whole = noise(5, 130, 16);
    for (const [first, last] of [
      [60, 120],
      [0, 60],
      [120, 130],
      [37, 38],
    ] as const) {
      expect(noise(5, last - first, 16, first)).toEqual(whole.slice(first * 16, last * 16));
    }
  });

  it('is standard normal, and seeds and neighbours are independent', () => {
    const values = noise(3, 1000, 64);
    const mean = (f: (value: number, i: number) => number): number =>
      values.reduce((sum, value, i) => sum + f(value, i), 0) / values.length;
    const limit = 5 / Math.sqrt(values.length);
    expect(Math.abs(mean((v) => v))).toBeLessThan(limit);
    expect(Math.abs(mean((v) => v * v) - 1)).toBeLessThan(limit * Math.SQRT2);
    expect(Math.abs(mean((v) => v ** 4) - 3)).toBeLessThan(limit * Math.sqrt(96));
    for (const other of [noise(4, 1000, 64), noise(3, 1000, 64, 1000)]) {
      expect(Math.abs(mean((v, i) => v * (other[i] ?? NaN)))).toBeLessThan(limit);
    }
    expect(Math.abs(mean((v, i) => v * (values[(i + 1) % values.length] ?? NaN)))).toBeLessThan(limit);
  });
});
