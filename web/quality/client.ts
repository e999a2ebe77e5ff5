import { runInWorker } from '../common/run-in-worker';
import type { Report } from './measure';
import type { Duet, Rules } from './rules';
import type { QualityTasks } from './worker';

export type { Moment, MomentKind } from './moments';
export type { Duet, Report, Rules };

export interface QualityQuestion {
  readonly duet: Duet;
  readonly rules: Rules;
}

/**
 * Measures a dance in a worker of its own, which the signal ends at once: a newer question need not wait for an older
 * one's answer.
 * @throws the signal's reason
 */
export async function measureDance(question: QualityQuestion, signal: AbortSignal): Promise<Report> {
  signal.throwIfAborted();
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'quality' });
  return runInWorker<QualityTasks, 'measure'>(worker, 'measure', question, { signal });
}
