import { AppError } from '../common/error';
import { runInWorker } from '../common/run-in-worker';
import type { LeaderFile } from './bvh/read';
import type { SolvedMotion } from './skeleton/clip';
import type { MotionTasks } from './worker';

export interface LeaderRequest {
  readonly text: string;
  /** Frame rate instead of the file's own. */
  readonly fps: number | null;
}

export interface ReadLeader {
  readonly file: LeaderFile;
  /** The same dancer on constant bone lengths. */
  readonly motion: SolvedMotion;
}

/**
 * Reads a BVH in a worker of its own, which is ended at once when the signal is aborted.
 * @throws {AppError} what is wrong with the file; `worker-crashed`
 * @throws the signal's reason
 */
export async function readLeader(request: LeaderRequest, signal?: AbortSignal): Promise<ReadLeader> {
  signal?.throwIfAborted();
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'leader' });
  return runInWorker<MotionTasks, 'read'>(worker, 'read', request, { signal, toError: workerError });
}

function workerError(reason: string): AppError {
  return new AppError(
    'worker-crashed',
    `The reading of the motion stopped unexpectedly (${reason}).`,
    'Try again. If it happens again, close other tabs or use a shorter motion.',
  );
}
