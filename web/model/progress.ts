/**
 * How far the sampling of a dance is, as one number that never goes back. Decoding and solving take a moment and report
 * nothing.
 */

export type Stage = 'condition' | 'step';

export interface Progress {
  readonly stage: Stage;
  /** Of the whole sampling, 0 to 1. */
  readonly fraction: number;
}

type ProgressListener = ((progress: Progress) => void) | undefined;
type StageListener = (done: number, total: number) => void;

/** Fractions of the whole, roughly as measured, so that the bar moves evenly. */
const FRACTIONS: Record<Stage, readonly [from: number, to: number]> = {
  condition: [0, 0.04],
  step: [0.04, 1],
};

/** Turns the progress of one stage into progress of the whole. */
export function stageProgress(onProgress: ProgressListener, stage: Stage): StageListener {
  const [from, to] = FRACTIONS[stage];
  return (done, total) => onProgress?.({ stage, fraction: from + ((to - from) * done) / total });
}
