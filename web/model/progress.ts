/** How far a generation is, as one number that never goes back. */

export type Stage = 'condition' | 'preview' | 'step' | 'decode' | 'solve';

export interface Progress {
  readonly stage: Stage;
  /** Pieces of this stage that are done, of `total`. */
  readonly done: number;
  readonly total: number;
  /** Of the whole generation, 0 to 1. */
  readonly fraction: number;
}

type ProgressListener = ((progress: Progress) => void) | undefined;
type StageListener = (done: number, total: number) => void;

/** Fractions of the whole, roughly as measured, so that the bar moves evenly. */
const FRACTIONS: Record<Exclude<Stage, 'preview'>, readonly [from: number, to: number]> = {
  condition: [0, 0.04],
  step: [0.04, 0.86],
  decode: [0.86, 0.94],
  solve: [0.94, 1],
};

/** Turns the progress of one stage into progress of the whole generation. */
export function stageProgress(onProgress: ProgressListener, stage: keyof typeof FRACTIONS): StageListener {
  const [from, to] = FRACTIONS[stage];
  return (done, total) => onProgress?.({ stage, done, total, fraction: from + ((to - from) * done) / total });
}

/**
 * The same for the preview and for the sampling steps, which share the fractions of `step` by their number of blocks.
 * @param doneBefore blocks that were done before this stage
 * @param allBlocks blocks of both stages
 */
export function blockProgress(
  onProgress: ProgressListener,
  stage: 'preview' | 'step',
  doneBefore: number,
  allBlocks: number,
): StageListener {
  const [from, to] = FRACTIONS.step;
  return (done, total) =>
    onProgress?.({ stage, done, total, fraction: from + ((to - from) * (doneBefore + done)) / allBlocks });
}
