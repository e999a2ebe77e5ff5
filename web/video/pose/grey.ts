import type { Picture } from './picture';

/** Reach of the mean that is taken out of a picture, so that exposure and vignettes do not matter, pixels. */
const LOCAL_REACH = 8;

/** Grey values of a picture, line by line. */
export interface Grey {
  readonly width: number;
  readonly height: number;
  readonly values: Float32Array;
}

/** Makes small pictures of grey values. */
export class GreyReader {
  readonly #context: OffscreenCanvasRenderingContext2D;

  constructor(readonly size: Pick<Grey, 'width' | 'height'>) {
    this.#context = new OffscreenCanvas(size.width, size.height).getContext('2d', {
      willReadFrequently: true,
    })!;
    this.#context.imageSmoothingQuality = 'medium';
  }

  /** height x width, 0 to 1. */
  read(picture: Picture): Float32Array {
    const { width, height } = this.size;
    this.#context.setTransform(width / picture.width, 0, 0, height / picture.height, 0, 0);
    picture.draw(this.#context);
    const { data } = this.#context.getImageData(0, 0, width, height);
    return Float32Array.from(
      { length: width * height },
      (_, i) => (data[4 * i]! + 2 * data[4 * i + 1]! + data[4 * i + 2]!) / (4 * 255),
    );
  }
}

/** A picture of half the size; its sides are even. */
export function halved({ width, height, values }: Grey): Grey {
  const out = { width: width / 2, height: height / 2, values: new Float32Array((width * height) / 4) };
  for (let y = 0; y < out.height; y++)
    for (let x = 0; x < out.width; x++) {
      const at = 2 * y * width + 2 * x;
      out.values[y * out.width + x] =
        (values[at]! + values[at + 1]! + values[at + width]! + values[at + width + 1]!) / 4;
    }
  return out;
}

/** A picture without the mean of each pixel's surroundings. */
export function withoutLocalMean({ width, height, values }: Grey): Grey {
  const across = runningMean(values, width, height, 1, width);
  const mean = runningMean(across, height, width, width, 1);
  return { width, height, values: values.map((value, i) => value - mean[i]!) };
}

/** Mean over `LOCAL_REACH` pixels on each side along lines, `step` from pixel to pixel and `next` from line to line. */
function runningMean(
  values: Float32Array,
  length: number,
  lines: number,
  step: number,
  next: number,
): Float32Array {
  const out = new Float32Array(values.length);
  for (let line = 0; line < lines; line++) {
    const at = (i: number): number => line * next + i * step;
    let [sum, from, to] = [0, 0, 0];
    for (let i = 0; i < length; i++) {
      for (; to < Math.min(length, i + LOCAL_REACH + 1); to++) sum += values[at(to)]!;
      for (; from < i - LOCAL_REACH; from++) sum -= values[at(from)]!;
      out[at(i)] = sum / (to - from);
    }
  }
  return out;
}
