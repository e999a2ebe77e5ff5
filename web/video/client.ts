import { AppError } from '../common/error';
import { loadPart } from '../common/page-part';
import { WorkerConnection } from '../common/run-in-worker';
import type { Observations } from './observations';
import type { Picture } from './pose/picture';
import type { Point } from './pose/region';
import type { PersonPick } from './pose/tracker';
import { DEFAULT_FOCAL } from './world/camera';
import { BONES } from './pose/landmark-names';
import type { WorldOptions } from './world/reconstruct';
import type { People, ReadReport, VideoMotion, VideoTasks } from './worker';

export { BONES, DEFAULT_FOCAL };
export type { Observations, People, PersonPick, Point, ReadReport, VideoMotion, WorldOptions };

/** Reads one video in a worker of its own, which is replaced after a crash. */
export interface VideoReader {
  /**
   * What is seen in all pictures of a video, or in those from the moment of `pick` on.
   * @param pick the person who is followed; null takes the largest
   * @param options how the motions are made that are reported meanwhile
   * @throws {AppError} what is wrong with the video
   * @throws the signal's reason
   */
  read(
    file: Blob,
    pick: PersonPick | null,
    options: Omit<WorldOptions, 'trim'>,
    signal: AbortSignal,
    onReport: (report: ReadReport) => void,
  ): Promise<Observations>;
  /**
   * Who could be followed from a moment on, seconds of the video, also while it is being read; null after its end.
   * @throws {AppError} what is wrong with the video
   * @throws the signal's reason
   */
  people(file: Blob, time: number, signal: AbortSignal): Promise<People | null>;
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
  let connection = connect();
  let disposed = false;
  const current = (): WorkerConnection<VideoTasks> => {
    if (connection.ended && !disposed) connection = connect();
    return connection;
  };
  const graphs = new URL('models/pose/pose.json', document.baseURI).href;
  return {
    read: (file, pick, options, signal, onReport) =>
      current().call('read', { file, graphs, pick, options }, { signal, onReport }),
    people: (file, time, signal) => current().call('people', { file, graphs, time }, { signal }),
    solve: (observations, options, signal) => current().call('solve', { observations, options }, { signal }),
    dispose: () => {
      disposed = true;
      connection.dispose();
    },
  };
}

function connect(): WorkerConnection<VideoTasks> {
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'video' });
  return new WorkerConnection<VideoTasks>(worker, { toError: crashed });
}

/** The pictures of a video in order, for drawing them beside something else. */
export interface Pictures {
  readonly width: number;
  readonly height: number;
  /**
   * Draws the picture that is shown at a moment, seconds of the video; `draw` is not called where it is still
   * the one that was drawn last. Moments ascend.
   */
  drawAt(seconds: number, draw: (picture: Picture) => void): Promise<void>;
  close(): void;
}

/**
 * Opens the pictures of a video from a moment on, seconds.
 * @throws {AppError} as reading the video does
 */
export async function openPictures(file: Blob, from: number): Promise<Pictures> {
  const { openVideo } = await loadPart(() => import('./frames'));
  const video = await openVideo(file);
  const pictures = video.pictures(from, Infinity);
  let coming: Awaited<ReturnType<typeof pictures.next>>;
  try {
    coming = await pictures.next();
  } catch (error) {
    video.close();
    throw error;
  }
  return {
    width: video.width,
    height: video.height,
    drawAt: async (seconds, draw) => {
      // Each picture is valid until the next one is asked for, so it is drawn before.
      while (!coming.done && coming.value.time <= seconds + 1e-3) {
        draw(coming.value.picture);
        coming = await pictures.next();
      }
    },
    close: () => {
      void pictures.return(undefined);
      video.close();
    },
  };
}
