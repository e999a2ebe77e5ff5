import { describe, expect, it } from 'vitest';
import { medianOfRow, medianWindows, reflectedIndex, replaceValue } from '../../../../web/audio/dsp/median';

/** Reproducible values with many ties, as spectra of silence have. */
function values(length: number): Float32Array {
  let state = 1;
  return Float32Array.from({ length }, () => {
    state = (state * 48271) % 2147483647;
    return (state % 17) / 4;
  });
}

/** The values as the bits of float32. */
function bitsOf(row: Float32Array): Int32Array {
  return new Int32Array(row.buffer, row.byteOffset, row.length);
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
    medianOfRow(bitsOf(row), 7, length, medianWindows(1, 31), bitsOf(out));
    const expected = Array.from({ length }, (_, i) => sortedMedian(row.subarray(7), i, 31));
    expect(Array.from(out)).toEqual(expected);
  });

  it('does not depend on what its window held before', () => {
    const row = values(50);
    const windows = medianWindows(1, 31);
    medianOfRow(
      bitsOf(Float32Array.from({ length: 60 }, (_, i) => 100 - i)),
      0,
      60,
      windows,
      new Int32Array(60),
    );
    const out = new Float32Array(50);
    medianOfRow(bitsOf(row), 0, 50, windows, bitsOf(out));
    expect(Array.from(out)).toEqual(Array.from(row, (_, i) => sortedMedian(row, i, 31)));
  });

  it('extends a row by reflection at both ends, repeatedly where needed', () => {
    const shown = [-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7].map((index) => reflectedIndex(index, 3));
    expect(shown).toEqual([1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]);
  });

  it('keeps windows side by side apart', () => {
    const windows = medianWindows(3, 3);
    const medians = [5, 5, 7, 2, 9, 1].map((value, step) => replaceValue(windows, 1, step % 3, value));
    expect(medians).toEqual([0, 5, 5, 5, 7, 2]);
    expect([replaceValue(windows, 0, 0, 3), replaceValue(windows, 2, 0, 3)]).toEqual([0, 0]);
  });
});
