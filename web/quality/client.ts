import { yieldToPage } from '../common/yield-to-events';
import { runInWorker } from '../common/run-in-worker';
import type { Report } from './measure';
import type { Duet, Rules } from './rules';
import type { QualityTasks } from './worker';

export type { Moment, MomentKind } from './moments';
export type { Duet, Report, Rules };

export interface QualityRequest {
  readonly duet: Duet;
  readonly rules: Rules;
}

/**
 * Measures a dance in a worker of its own, which is ended at once when the signal is aborted, so that a newer request
 * need not wait for an older one.
 * @throws the signal's reason
 */
export async function measureDance(request: QualityRequest, signal: AbortSignal): Promise<Report> {
  // Copying the dance to the worker is a task of its own: the dance has just been put on the stage.
  await yieldToPage();
  signal.throwIfAborted();
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'quality' });
  return runInWorker<QualityTasks, 'measure'>(worker, 'measure', request, { signal });
}
