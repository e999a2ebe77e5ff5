import { AppError } from '../common/error';
import { WorkerConnection } from '../common/run-in-worker';
import type { Observations } from './observations';
import type { Point } from './pose/tracker';
import { DEFAULT_FOCAL } from './world/camera';
import { BONES } from './world/landmark-names';
import { FPS } from './world/series';
import type { WorldOptions } from './world/reconstruct';
import type { ReadReport, VideoMotion, VideoTasks } from './worker';

export { BONES, DEFAULT_FOCAL, FPS };
export type { Observations, Point, ReadReport, VideoMotion, WorldOptions };

/** Reads one video in a worker of its own. */
export interface VideoReader {
  /**
   * What is seen in all pictures of a video.
   * @param pick where the person stands who is followed; null takes the largest
   * @throws {AppError} what is wrong with the video
   * @throws the signal's reason
   */
  read(
    file: Blob,
    pick: Point | null,
    signal: AbortSignal,
    onReport: (report: ReadReport) => void,
  ): Promise<Observations>;
  /** The motion of the dancer. @throws {AppError} */
  solve(observations: Observations, options: WorldOptions, signal: AbortSignal): Promise<VideoMotion>;
  /** Ends the worker and with it the download, decoding and networks. */
  dispose(): void;
}

function crashed(reason: string): AppError {
  return new AppError(
    'worker-crashed',
    `Reading the video stopped unexpectedly: ${reason}`,
    'Try again; if it stops again, use a shorter or smaller video.',
  );
}

export function createVideoReader(): VideoReader {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'video' });
  const connection = new WorkerConnection<VideoTasks>(worker, { toError: crashed });
  const graphs = new URL('models/pose/pose.json', document.baseURI).href;
  return {
    read: (file, pick, signal, onReport) =>
      connection.call('read', { file, graphs, pick }, { signal, onReport }),
    solve: (observations, options, signal) => connection.call('solve', { observations, options }, { signal }),
    dispose: () => {
      connection.dispose();
    },
  };
}
