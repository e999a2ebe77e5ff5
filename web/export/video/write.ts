import { AppError } from '../../common/error';
import { encodeVideo } from './encode';
import type { VideoSource, VideoOptions } from './source';
import type { VideoPlan } from './plan';
import { recordVideo } from './record';

/**
 * Writes a video as planned.
 *
 * @throws {AppError} `video-failed`, `sound-failed`; errors of the drawing as they are; the signal's reason at once
 * when it is aborted
 */
export async function writeVideo(source: VideoSource, plan: VideoPlan, options: VideoOptions): Promise<Blob> {
  const { signal } = options;
  signal.throwIfAborted();
  const aborted = new Promise<never>((_, reject) => {
    signal.addEventListener('abort', () => reject(signal.reason as Error), { once: true });
  });
  const work =
    plan.way === 'encode' ? encodeVideo(source, plan, options) : recordVideo(source, plan, options);
  // Cancelling does not wait for the encoder, whose result is ignored then.
  work.catch(() => undefined);
  try {
    return await Promise.race([work, aborted]);
  } catch (error) {
    signal.throwIfAborted();
    if (error instanceof AppError) throw error;
    throw new AppError(
      'video-failed',
      'The video could not be written.',
      'Try the smaller size, or close other tabs and try again. The dance and your settings are unchanged.',
      { cause: error },
    );
  }
}
