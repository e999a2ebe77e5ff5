import { describe, expect, it } from 'vitest';
import { medianOfRow, reflectedIndex, replaceSorted } from '../../../../web/audio/dsp/median';

/** Reproducible values with many ties, as spectra of silence have. */
function values(length: number): Float32Array {
  let state = 1;
  return Float32Array.from({ length }, () => {
    state = (state * 48271) % 2147483647;
    return (state % 17) / 4;
  });
}

function sortedMedian(row: Float32Array, centre: number, kernel: number): number {
  const half = (kernel - 1) / 2;
  const window = Array.from(
    { length: kernel },
    (_, k) => row[reflectedIndex(centre + k - half, row.length)]!,
  );
  return window.sort((a, b) => a - b)[half]!;
}

describe('the running median', () => {
  it.each([1, 2, 3, 15, 16, 31, 40, 200])('equals a sort of every window in a row of %i', (length) => {
    const row = values(length + 7);
    const out = new Float32Array(length);
    medianOfRow(row, 7, length, 31, out);
    const expected = Array.from({ length }, (_, i) => sortedMedian(row.subarray(7), i, 31));
    expect(Array.from(out)).toEqual(expected);
  });

  it('extends a row by reflection at both ends, repeatedly where needed', () => {
    const shown = [-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7].map((index) => reflectedIndex(index, 3));
    expect(shown).toEqual([1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]);
  });

  it('keeps the neighbours of a replaced run', () => {
    const run = Float32Array.of(9, 1, 2, 3, 0);
    replaceSorted(run, 1, 3, 1, 5);
    expect(Array.from(run)).toEqual([9, 2, 3, 5, 0]);
    replaceSorted(run, 1, 3, 5, 1);
    expect(Array.from(run)).toEqual([9, 1, 2, 3, 0]);
  });
});
