import { AppError } from '../common/error';
import { runInWorker } from '../common/run-in-worker';
import type { Inspection } from './import/inspect';
import type { FileBytes } from './import/read';
import type { LeaderFile } from './retarget/leader';
import type { ImportOptions, RememberedJoints } from './retarget/options';
import type { SolvedMotion } from './skeleton/clip';
import type { MotionTasks } from './worker';

/** A motion file, with the files that belong to it after it, and what is set by hand about it. */
export interface LeaderRequest {
  readonly files: readonly FileBytes[];
  readonly options: ImportOptions;
  /** Joints that were chosen for skeletons of earlier files. */
  readonly remembered?: RememberedJoints;
}

export interface ReadLeader {
  readonly file: LeaderFile;
  /** The same dancer on constant bone lengths. */
  readonly motion: SolvedMotion;
}

/**
 * Reads a motion file in a worker of its own, which is ended at once when the signal is aborted.
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
    `Reading the motion stopped unexpectedly (${reason}).`,
    'Try again. If it happens again, close other tabs or use a shorter motion.',
  );
}

/**
 * Reads only the joints of a motion file, and which of the 22 they are taken for.
 * @throws {AppError} what is wrong with the file itself
 */
export async function inspectLeader(request: LeaderRequest): Promise<Inspection> {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'leader' });
  return runInWorker<MotionTasks, 'inspect'>(worker, 'inspect', request);
}
