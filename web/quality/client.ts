import type { Report } from './measure';
import type { Duet, Rules } from './rules';

export type { Moment, MomentKind } from './moments';
export type { Duet, Report, Rules };

export interface QualityQuestion {
  readonly duet: Duet;
  readonly rules: Rules;
}

export type QualityAnswer = Report;

/**
 * Measures a dance in a worker of its own, which the signal ends at once: a newer question need not wait for an older
 * one's answer.
 * @throws the signal's reason
 */
export function measureDance(question: QualityQuestion, signal: AbortSignal): Promise<Report> {
  return new Promise((resolve, reject) => {
    signal.throwIfAborted();
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'quality' });
    const end = (): void => {
      worker.terminate();
      signal.removeEventListener('abort', cancel);
    };
    const cancel = (): void => {
      end();
      reject(signal.reason as Error);
    };
    signal.addEventListener('abort', cancel);
    worker.onerror = (event) => {
      event.preventDefault();
      end();
      reject(new Error(event.message || 'The measuring stopped.'));
    };
    worker.onmessage = ({ data }: MessageEvent<QualityAnswer>) => {
      end();
      resolve(data);
    };
    worker.postMessage(question);
  });
}
