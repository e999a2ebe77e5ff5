/** A bank of linear filters over the bins of a spectrum; each stores only the bins from its first to its last non-zero weight. */
export interface FilterBank {
  readonly filters: readonly { readonly first: number; readonly weights: Float64Array }[];
}

/** Builds a bank from dense rows of one weight per bin. */
export function filterBank(rows: readonly Float64Array[]): FilterBank {
  return {
    filters: rows.map((row) => {
      const first = Math.max(
        0,
        row.findIndex((weight) => weight !== 0),
      );
      const last = row.findLastIndex((weight) => weight !== 0);
      return { first, weights: row.slice(first, last + 1) };
    }),
  };
}

/**
 * Squares of the magnitudes of one spectrum.
 *
 * @param magnitude holds the spectrum from index `offset` on
 * @param out receives as many powers as it is long
 */
export function powers(magnitude: Float32Array, offset: number, out: Float64Array): void {
  for (let bin = 0; bin < out.length; bin++) {
    const value = magnitude[offset + bin]!;
    out[bin] = value * value;
  }
}

/**
 * Weighted sums of the powers of one spectrum, one for each filter.
 *
 * @param out receives the sums from index `offset` on
 */
export function applyFilters(bank: FilterBank, power: Float64Array, out: Float64Array, offset: number): void {
  bank.filters.forEach(({ first, weights }, index) => {
    // Four sums, because each addition to one has to wait for the one before.
    let a = 0;
    let b = 0;
    let c = 0;
    let d = 0;
    let i = 0;
    for (; i + 3 < weights.length; i += 4) {
      a += weights[i]! * power[first + i]!;
      b += weights[i + 1]! * power[first + i + 1]!;
      c += weights[i + 2]! * power[first + i + 2]!;
      d += weights[i + 3]! * power[first + i + 3]!;
    }
    for (; i < weights.length; i++) a += weights[i]! * power[first + i]!;
    out[offset + index] = a + b + c + d;
  });
}
