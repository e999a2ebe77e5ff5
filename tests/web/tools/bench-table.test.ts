import { describe, expect, it } from 'vitest';
import { table, withRatios } from '../../../tools/bench/table.mjs';

const rows = withRatios([
  {
    backend: 'browser wasm',
    threads: 2,
    seconds: {
      features: 1,
      condition: 0.5,
      steps: 5,
      decode: 0.5,
      solve: 2,
      branches: 12,
      preview: 0.06,
      renewed: 0.4,
    },
    first: { features: 2, condition: 1, steps: 6, decode: 1, solve: 2 },
  },
  {
    backend: 'onnxruntime native',
    threads: 2,
    seconds: { features: 3, condition: 0.5, steps: 1, decode: 0.5 },
  },
  { backend: 'PyTorch eager', threads: 2, seconds: { features: 3, condition: 1, steps: 2, decode: 1 } },
]);

describe('the table of the bench', () => {
  it('adds all stages up, and compares the graphs alone', () => {
    expect(rows.map(({ total }) => total)).toEqual([9, 5, 7]);
    expect(rows.map(({ toEager }) => toEager)).toEqual([1.5, 0.5, 1]);
    expect(rows.map(({ toNative }) => toNative)).toEqual([3, 1, 2]);
  });

  it('leaves out what a backend does not have', () => {
    const [, , wasm, native] = table(rows)
      .split('\n')
      .map((line) => line.split('|').map((cell) => cell.trim()));
    expect(wasm?.slice(1, -1)).toEqual([
      'browser wasm',
      '2',
      '1.00',
      '0.50',
      '5.00',
      '0.50',
      '2.00',
      '9.00',
      '12.00',
      '1.50',
      '3.00',
      '12.00',
      '0.06',
      '0.40',
    ]);
    expect(native?.slice(7, 10)).toEqual(['-', '5.00', '-']);
    expect(native?.slice(-4, -1)).toEqual(['-', '-', '-']);
  });
});
