import type { PictureSize } from '../../common/picture';
import { openPictures } from '../../video/client';

/** Pictures of the dance for an exported video, as the stage draws them; times ascend. */
interface Drawn {
  readonly canvas: HTMLCanvasElement;
  readonly drawAt: (seconds: number) => void | Promise<void>;
  readonly dispose: () => void;
}

/** The halves of a picture: beside each other in a wide one, one above the other in a tall one. */
export function halves({ width, height }: PictureSize): {
  readonly size: PictureSize;
  readonly second: { readonly x: number; readonly y: number };
} {
  // Encoders take even sizes, and so do the halves.
  const half = (pixels: number): number => 2 * Math.round(pixels / 4);
  return width >= height
    ? { size: { width: half(width), height }, second: { x: width - half(width), y: 0 } }
    : { size: { width, height: half(height) }, second: { x: 0, y: height - half(height) } };
}

/**
 * Draws the leader's video in one half of the picture, whole and in step, and the dance in the other half.
 * @param video its file, and the moment at which the dance begins, seconds
 * @param begin moment of the dance of the first picture, seconds
 * @param openStage opens what draws the dance in a size
 * @throws {AppError} what is wrong with the video
 */
export async function openBeside(
  whole: PictureSize,
  { file, start }: { readonly file: Blob; readonly start: number },
  begin: number,
  openStage: (size: PictureSize) => Promise<Drawn>,
): Promise<Drawn> {
  const { size, second } = halves(whole);
  const pictures = await openPictures(file, start + begin);
  let stage: Drawn;
  try {
    stage = await openStage(size);
  } catch (error) {
    pictures.close();
    throw error;
  }
  const canvas = Object.assign(document.createElement('canvas'), whole);
  const context = canvas.getContext('2d', { alpha: false })!;
  const scale = Math.min(size.width / pictures.width, size.height / pictures.height);
  const [width, height] = [scale * pictures.width, scale * pictures.height];
  return {
    canvas,
    drawAt: async (seconds) => {
      await pictures.drawAt(start + seconds, (picture) => {
        context.setTransform(scale, 0, 0, scale, (size.width - width) / 2, (size.height - height) / 2);
        picture.draw(context);
        context.resetTransform();
      });
      await stage.drawAt(seconds);
      context.drawImage(stage.canvas, second.x, second.y, size.width, size.height);
    },
    dispose: () => {
      pictures.close();
      stage.dispose();
    },
  };
}
