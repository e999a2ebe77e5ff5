import { AppError } from '../../common/error';
import type { PictureSize } from '../../common/picture';
import { captioned } from '../../export/client';
import type { AppState } from '../store/state';

/** A stage that draws the dance, as it was when the stage was opened, for a picture or the frames of a video. */
export interface VideoStage {
  readonly canvas: HTMLCanvasElement;
  /** Draws the dance at `seconds`; times ascend. */
  readonly drawAt: (seconds: number) => void | Promise<void>;
  readonly dispose: () => void;
}

/** Opens a stage, framed as the one on the page, whose first picture is of the moment `begin`, seconds. */
export type OpenStage = (size: PictureSize, begin: number) => Promise<VideoStage>;

/**
 * The moment that the stage shows as a PNG, with the credit of a video.
 *
 * @throws {AppError} `picture-failed` when the browser cannot write so large a picture
 */
export async function pictureOf(
  open: OpenStage,
  size: PictureSize,
  { playback: { time }, download: { credit }, theme }: AppState,
): Promise<Blob> {
  const stage = await open(size, time);
  try {
    await stage.drawAt(time);
    const { canvas, draw } = captioned(stage.canvas, { title: '', credit }, theme);
    draw(time);
    return await pngOf(canvas);
  } finally {
    stage.dispose();
  }
}

/** What the canvas shows now, also if it is cleared after this task. */
function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) => {
    canvas.toBlob((png) => {
      if (png) resolve(png);
      else
        reject(new AppError('picture-failed', 'The picture could not be written.', 'Choose a smaller size.'));
    });
  });
}
