import type { VideoSample } from 'mediabunny';
import type { PictureSize } from '../../common/picture';
import { DETECTOR_SIDE } from './detector';
import { LANDMARK_SIDE } from './landmarks';
import type { Region, Square } from './region';

/** A picture of a video, upright as it is shown. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  /** Draws the whole picture at its own size. */
  draw(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D): void;
}

/**
 * The picture of a decoded sample; rotation metadata and pixels that are not square are taken into account.
 * @param size that of the whole video as it is shown, pixels: WebKit decodes to another one where pixels are not square
 */
export function pictureOf(sample: VideoSample, { width, height }: PictureSize): Picture {
  const [across, down] = sample.rotation % 180 === 0 ? [width, height] : [height, width];
  return {
    width,
    height,
    // Not by `sample.draw`, which exchanges the sides of pictures that lie on their side and stretches them back: drawn
    // at another size than its own, a picture takes Chromium several times as long, and phones record them so.
    draw: (context) => {
      context.save();
      context.translate(width / 2, height / 2);
      if (sample.flip) context.scale(-1, 1);
      context.rotate((sample.rotation * Math.PI) / 180);
      context.drawImage(sample.toCanvasImageSource(), -across / 2, -down / 2, across, down);
      context.restore();
    },
  };
}

/**
 * Copies pictures, so that a browser makes RGB of each once, however often it is drawn. Where one is drawn much smaller,
 * a copy is halved first, as often as needed: Firefox and WebKit otherwise leave out pixels, whatever
 * `imageSmoothingQuality` says.
 */
export class PictureCopier {
  /** The copy, and each time half of it. */
  readonly #copies: OffscreenCanvasRenderingContext2D[] = [];

  /** The same picture; valid until the next one is copied. It is copied when it is drawn for the first time. */
  copyOf(picture: Picture): Picture {
    const { width, height } = picture;
    let made = 0;
    return {
      width,
      height,
      draw: (context) => {
        const { a, b } = context.getTransform();
        const wanted = halvings(Math.hypot(a, b));
        for (; made <= wanted; made++) {
          const copy = this.#blank(made, width, height);
          if (made === 0) picture.draw(copy);
          else copy.drawImage(this.#copies[made - 1]!.canvas, 0, 0, copy.canvas.width, copy.canvas.height);
        }
        context.drawImage(this.#copies[wanted]!.canvas, 0, 0, width, height);
      },
    };
  }

  /** Where the copy of a picture goes that is halved so many times. */
  #blank(times: number, width: number, height: number): OffscreenCanvasRenderingContext2D {
    const size = { width: Math.ceil(width / 2 ** times), height: Math.ceil(height / 2 ** times) };
    const context = (this.#copies[times] ??= new OffscreenCanvas(size.width, size.height).getContext('2d', {
      alpha: false,
      willReadFrequently: true,
    })!);
    const { canvas } = context;
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    return context;
  }
}

/** How often a picture that is drawn at this scale can be halved and is still no smaller than it is drawn. */
function halvings(scale: number): number {
  return scale > 0 ? Math.max(0, Math.floor(-Math.log2(scale))) : 0;
}

/** Cuts what a network sees out of pictures. */
export class Cropper {
  readonly #canvases = new Map<number, OffscreenCanvasRenderingContext2D>();

  /** A region of the picture as the landmark network takes it: 3 x 256 x 256, 0 to 1; black outside the picture. */
  landmarkInput(picture: Picture, { x, y, size, angle }: Region): Float32Array {
    const context = this.#blank(LANDMARK_SIDE);
    const scale = LANDMARK_SIDE / size;
    context.translate(LANDMARK_SIDE / 2, LANDMARK_SIDE / 2);
    context.rotate(-angle);
    context.scale(scale, scale);
    context.translate(-x, -y);
    picture.draw(context);
    return channels(context, LANDMARK_SIDE, 1 / 255, 0);
  }

  /** A square of the picture as the detector takes it: 3 x 224 x 224, -1 to 1; black outside the picture. */
  detectorInput(
    picture: Picture,
    { x, y, side }: Square,
  ): {
    readonly input: Float32Array;
    /** Mean of what of the picture is in the square, 0 to 1. */
    readonly brightness: number;
  } {
    const context = this.#blank(DETECTOR_SIDE);
    context.scale(DETECTOR_SIDE / side, DETECTOR_SIDE / side);
    context.translate(-x, -y);
    picture.draw(context);
    const input = channels(context, DETECTOR_SIDE, 2 / 255, -1);
    const mean = input.reduce((sum, value) => sum + (value + 1) / 2, 0) / input.length;
    const inside = (from: number, length: number): number =>
      (Math.min(from + side, length) - Math.max(from, 0)) / side;
    return { input, brightness: mean / (inside(x, picture.width) * inside(y, picture.height)) };
  }

  #blank(side: number): OffscreenCanvasRenderingContext2D {
    let context = this.#canvases.get(side);
    if (!context) {
      // Read back at each picture: a canvas on a graphics card would be copied each time.
      context = new OffscreenCanvas(side, side).getContext('2d', { willReadFrequently: true })!;
      context.imageSmoothingQuality = 'medium';
      this.#canvases.set(side, context);
    }
    context.resetTransform();
    context.fillStyle = '#000';
    context.fillRect(0, 0, side, side);
    return context;
  }
}

/** RGB of a canvas, channel by channel, each value times `scale` plus `offset`. */
function channels(
  context: OffscreenCanvasRenderingContext2D,
  side: number,
  scale: number,
  offset: number,
): Float32Array {
  const { data } = context.getImageData(0, 0, side, side);
  const pixels = side * side;
  const out = new Float32Array(3 * pixels);
  for (let i = 0; i < pixels; i++)
    for (let channel = 0; channel < 3; channel++)
      out[channel * pixels + i] = data[4 * i + channel]! * scale + offset;
  return out;
}
