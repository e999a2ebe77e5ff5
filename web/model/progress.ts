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

type Told = ((progress: Progress) => void) | undefined;

// Shares of the whole, roughly as measured, so that the bar moves evenly.
const SHARES: Record<Exclude<Stage, 'preview'>, readonly [from: number, to: number]> = {
  condition: [0, 0.04],
  step: [0.04, 0.86],
  decode: [0.86, 0.94],
  solve: [0.94, 1],
};

/** Progress of one stage as progress of the whole. */
export function tell(onProgress: Told, stage: keyof typeof SHARES): (done: number, total: number) => void {
  const [from, to] = SHARES[stage];
  return (done, total) => onProgress?.({ stage, done, total, fraction: from + ((to - from) * done) / total });
}

/** Progress of preview or steps, which share the stretch of the steps: `before` blocks were done ahead of `runs`. */
export function tellRuns(
  onProgress: Told,
  stage: 'preview' | 'step',
  before: number,
  runs: number,
): (done: number, total: number) => void {
  const [from, to] = SHARES.step;
  const all = before + runs;
  return (done, total) =>
    onProgress?.({ stage, done, total, fraction: from + ((to - from) * (before + done)) / all });
}
