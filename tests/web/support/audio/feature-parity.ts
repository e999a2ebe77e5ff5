import type { AudioRecipe } from '../../../../web/audio/recipe';

/** How close two feature matrices are, for one group of columns. */
export interface GroupAgreement {
  readonly group: string;
  /** Smallest Pearson correlation of a column. */
  readonly correlation: number;
  /** Largest mean absolute difference of a column, in standard deviations of the reference column. */
  readonly difference: number;
}

/** First and last column (exclusive) of every group but the beats, by its name. */
export function columnGroups({ mfcc, chroma }: AudioRecipe): Record<string, readonly [number, number]> {
  return {
    MFCC: [0, mfcc],
    'MFCC delta': [mfcc, 2 * mfcc],
    chroma: [2 * mfcc, 2 * mfcc + chroma],
    onset: [2 * mfcc + chroma, 2 * mfcc + chroma + 1],
  };
}

/**
 * Compares feature matrices column by column. Columns that are constant in the reference have no correlation and must
 * be equal.
 *
 * @param ours frames x recipe.features
 * @param reference the same by librosa
 */
export function agreement(
  ours: Float32Array,
  reference: Float32Array,
  recipe: AudioRecipe,
): GroupAgreement[] {
  return Object.entries(columnGroups(recipe)).map(([group, [first, end]]) => {
    const columns = Array.from({ length: end - first }, (_, index) => {
      const [a, b] = [ours, reference].map((matrix) => column(matrix, first + index, recipe.features)) as [
        number[],
        number[],
      ];
      return compareColumns(a, b);
    });
    return {
      group,
      correlation: Math.min(...columns.map((one) => one.correlation)),
      difference: Math.max(...columns.map((one) => one.difference)),
    };
  });
}

/**
 * F-measure of beats against reference beats, each of which may be matched once.
 *
 * @param tolerance frames
 */
export function beatAgreement(
  ours: readonly number[],
  reference: readonly number[],
  tolerance: number,
): number {
  if (ours.length + reference.length === 0) return 1;
  const free = [...reference];
  let hits = 0;
  for (const beat of ours) {
    const match = free.findIndex((other) => Math.abs(other - beat) <= tolerance);
    if (match < 0) continue;
    free.splice(match, 1);
    hits++;
  }
  return (2 * hits) / (ours.length + reference.length);
}

/** Frames whose last column is set. */
export function beatFrames(matrix: Float32Array, recipe: AudioRecipe): number[] {
  return column(matrix, recipe.features - 1, recipe.features).flatMap((value, frame) =>
    value > 0.5 ? [frame] : [],
  );
}

/** The onset strength of every frame. */
export function onsetStrength(matrix: Float32Array, recipe: AudioRecipe): number[] {
  return column(matrix, recipe.features - 2, recipe.features);
}

function column(matrix: Float32Array, index: number, width: number): number[] {
  return Array.from({ length: matrix.length / width }, (_, row) => matrix[row * width + index]!);
}

function compareColumns(ours: number[], reference: number[]): { correlation: number; difference: number } {
  const difference = mean(ours.map((value, i) => Math.abs(value - reference[i]!)));
  const [a, b] = [ours, reference].map((values) => {
    const centre = mean(values);
    return values.map((value) => value - centre);
  }) as [number[], number[]];
  const [deviationA, deviationB] = [a, b].map((values) =>
    Math.sqrt(mean(values.map((value) => value ** 2))),
  ) as [number, number];
  if (deviationB === 0)
    return { correlation: difference === 0 ? 1 : 0, difference: difference === 0 ? 0 : Infinity };
  return {
    correlation: mean(a.map((value, i) => value * b[i]!)) / (deviationA * deviationB),
    difference: difference / deviationB,
  };
}

function mean(values: number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}
