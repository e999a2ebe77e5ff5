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
 * Weighted sums of the powers (squared magnitudes) of one spectrum, one for each filter.
 *
 * @param magnitude holds the spectrum from index `offset` on
 * @param out receives the sums from index `outOffset` on
 */
export function applyToPower(
  bank: FilterBank,
  magnitude: Float32Array,
  offset: number,
  out: Float64Array,
  outOffset: number,
): void {
  bank.filters.forEach(({ first, weights }, index) => {
    let sum = 0;
    for (let i = 0; i < weights.length; i++) {
      const value = magnitude[offset + first + i]!;
      sum += weights[i]! * value * value;
    }
    out[outOffset + index] = sum;
  });
}
