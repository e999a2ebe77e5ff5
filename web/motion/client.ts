import type { LeaderFile } from './bvh/read';
import type { SolvedMotion } from './skeleton/clip';
import { AppError, type ErrorCode } from '../common/error';

export interface LeaderQuestion {
  readonly text: string;
  /** Frame rate instead of the file's own. */
  readonly fps: number | null;
}

export type LeaderAnswer =
  | { readonly ok: true; readonly file: LeaderFile; readonly motion: SolvedMotion }
  | {
      readonly ok: false;
      readonly failure: {
        readonly code: ErrorCode;
        readonly message: string;
        readonly hint: string;
      } | null;
    };

export interface ReadLeader {
  readonly file: LeaderFile;
  /** The same dancer on constant bone lengths. */
  readonly motion: SolvedMotion;
}

/**
 * Reads a BVH in a worker of its own, which the signal ends at once.
 * @throws {AppError} what is wrong with the file
 * @throws the signal's reason
 */
export function readLeader(question: LeaderQuestion, signal?: AbortSignal): Promise<ReadLeader> {
  return new Promise((resolve, reject) => {
    signal?.throwIfAborted();
    const worker = new Worker(new URL('./worker.ts', import.meta.url), {
      type: 'module',
      name: 'leader',
    });
    const end = (): void => {
      worker.terminate();
      signal?.removeEventListener('abort', cancel);
    };
    const fail = (error: Error): void => {
      end();
      reject(error);
    };
    const cancel = (): void => {
      fail(signal?.reason as Error);
    };
    signal?.addEventListener('abort', cancel);
    worker.onerror = (event) => {
      fail(new Error(event.message || 'The reader stopped.'));
    };
    worker.onmessage = ({ data }: MessageEvent<LeaderAnswer>) => {
      if (data.ok) {
        end();
        resolve({ file: data.file, motion: data.motion });
      } else if (data.failure) fail(new AppError(data.failure.code, data.failure.message, data.failure.hint));
      else fail(new Error('The reader failed for an unknown reason.'));
    };
    worker.postMessage(question);
  });
}
