import { type Rotation, VideoSample } from 'mediabunny';
import { afterEach, expect, test, vi } from 'vitest';
import { PictureCopier, pictureOf } from '../../../../web/video/pose/picture';

/** A decoded picture of 4 x 2 square pixels. */
class Frame {
  readonly displayWidth = 4;
  readonly displayHeight = 2;
  readonly codedWidth = 4;
  readonly codedHeight = 2;
  readonly format = 'I420';
  readonly timestamp = 0;
  readonly visibleRect = { x: 0, y: 0, width: 4, height: 2 };
  readonly colorSpace = {};
  close = (): void => undefined;
}

/** Keeps where the corners of what is drawn come to lie, and the size at which it is drawn. */
class Context {
  /** x' = a x + c y + e, y' = b x + d y + f. */
  #matrix = { a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 };
  readonly #saved: { a: number; b: number; c: number; d: number; e: number; f: number }[] = [];
  drawn: { readonly size: number[]; readonly topLeft: number[]; readonly bottomRight: number[] } | null =
    null;

  save(): void {
    this.#saved.push({ ...this.#matrix });
  }
  restore(): void {
    this.#matrix = this.#saved.pop()!;
  }
  translate(x: number, y: number): void {
    [this.#matrix.e, this.#matrix.f] = this.#at(x, y) as [number, number];
  }
  scale(x: number, y: number): void {
    const { a, b, c, d } = this.#matrix;
    Object.assign(this.#matrix, { a: a * x, b: b * x, c: c * y, d: d * y });
  }
  rotate(angle: number): void {
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const { a, b, c, d } = this.#matrix;
    Object.assign(this.#matrix, {
      a: a * cos + c * sin,
      b: b * cos + d * sin,
      c: c * cos - a * sin,
      d: d * cos - b * sin,
    });
  }
  drawImage(_: unknown, ...numbers: number[]): void {
    const [x, y, width, height] = numbers.slice(-4) as [number, number, number, number];
    this.drawn = {
      size: [width, height],
      topLeft: this.#at(x, y),
      bottomRight: this.#at(x + width, y + height),
    };
  }
  #at(x: number, y: number): number[] {
    const { a, b, c, d, e, f } = this.#matrix;
    return [a * x + c * y + e, b * x + d * y + f].map((value) => Math.round(value * 1e6) / 1e6 + 0);
  }
}

afterEach(() => {
  vi.unstubAllGlobals();
});

test.each([
  [0, false, [4, 2], [0, 0], [4, 2]],
  [90, false, [2, 4], [2, 0], [0, 4]],
  [180, false, [4, 2], [4, 2], [0, 0]],
  [270, false, [2, 4], [0, 4], [2, 0]],
  [0, true, [4, 2], [4, 0], [0, 2]],
  [90, true, [2, 4], [0, 0], [2, 4]],
] as [Rotation, boolean, number[], number[], number[]][])(
  'a picture turned by %i degrees, mirrored: %s, is drawn upright and at its own size, which is quick',
  (rotation, flip, size, topLeft, bottomRight) => {
    vi.stubGlobal('VideoFrame', Frame);
    const sample = new VideoSample(new Frame() as unknown as VideoFrame, { rotation, flip });
    const [width = 0, height = 0] = size;
    const picture = pictureOf(sample, { width, height });
    const context = new Context();
    picture.draw(context as unknown as OffscreenCanvasRenderingContext2D);
    sample.close();
    expect(context.drawn).toEqual({ size: [4, 2], topLeft, bottomRight });
  },
);

test('a picture has the size of its video, whatever size it is decoded to', () => {
  vi.stubGlobal('VideoFrame', Frame);
  const sample = new VideoSample(new Frame() as unknown as VideoFrame, { rotation: 90 });
  const picture = pictureOf(sample, { width: 8, height: 12 });
  const context = new Context();
  picture.draw(context as unknown as OffscreenCanvasRenderingContext2D);
  sample.close();
  expect([picture.width, picture.height]).toEqual([8, 12]);
  expect(context.drawn).toEqual({ size: [12, 8], topLeft: [8, 0], bottomRight: [0, 12] });
});

/** Draws nothing, and knows from which canvas and how often it was asked to. */
class Canvas {
  readonly drawn: Canvas[] = [];
  scale = 1;
  constructor(
    public width: number,
    public height: number,
  ) {}
  getContext(): unknown {
    return {
      canvas: this,
      getTransform: () => ({ a: 0, b: this.scale }),
      drawImage: (from: Canvas) => this.drawn.push(from),
    };
  }
}

test('a picture that is drawn much smaller is halved before, so that no browser leaves out pixels', () => {
  vi.stubGlobal('OffscreenCanvas', Canvas);
  const source = new Canvas(0, 0);
  const copy = new PictureCopier().copyOf({
    width: 60,
    height: 33,
    draw: (context) => {
      context.drawImage(source as unknown as OffscreenCanvas, 0, 0);
    },
  });
  const drawnFrom = (scale: number): Canvas => {
    const target = new Canvas(10, 10);
    target.scale = scale;
    copy.draw(target.getContext() as OffscreenCanvasRenderingContext2D);
    return target.drawn[0]!;
  };
  const sizes = [2, 1, 0.51, 0.5, 0.3, 0.1].map((scale) => {
    const { width, height } = drawnFrom(scale);
    return [width, height];
  });
  expect(sizes).toEqual([
    [60, 33],
    [60, 33],
    [60, 33],
    [30, 17],
    [30, 17],
    [8, 5],
  ]);
  // Each is made once, of the one before.
  expect(drawnFrom(1).drawn).toEqual([source]);
  expect(drawnFrom(0.5).drawn).toEqual([drawnFrom(1)]);
});
