import { expect, it } from 'vitest';
import { CutFinder } from '../../../../web/video/pose/cuts';
import type { Grey } from '../../../../web/video/pose/grey';

const [width, height] = [96, 128];

/** A picture of grey values by place, across and down from 0 to 1. */
function picture(grey: (x: number, y: number) => number): Grey {
  return {
    width,
    height,
    values: Float32Array.from({ length: width * height }, (_, i) =>
      Math.min(1, Math.max(0, grey((i % width) / width, Math.floor(i / width) / height))),
    ),
  };
}

/** A room that is seen from `aside`, in which a dancer moves. */
const room =
  (aside: number, time: number, light = 0) =>
  (x: number, y: number): number => {
    const [u, v] = [x + aside, y];
    const dancer = Math.hypot(x - 0.5 - 0.1 * Math.sin(5 * time), y - 0.5) < 0.15 ? 0.3 : 0;
    return (
      0.5 + light + 0.15 * Math.sin(17 * u + 3) * Math.cos(11 * v) + 0.12 * Math.sin(9 * v + 6 * u) - dancer
    );
  };

/** Cuts in pictures at 20 a second. */
function cutsIn(pictures: readonly Grey[]): number[] {
  const finder = new CutFinder();
  pictures.forEach((one, i) => finder.next(one, i / 20));
  return finder.times;
}

const frames = (count: number, of: (frame: number) => Grey): Grey[] =>
  Array.from({ length: count }, (_, frame) => of(frame));

it('finds a change to another camera', () => {
  const pictures = frames(60, (frame) => picture(room(frame < 24 ? 0 : 7, frame / 20)));
  expect(cutsIn(pictures)).toEqual([24 / 20]);
});

it('tells it at once, by the pictures before it', () => {
  const finder = new CutFinder();
  const told = frames(30, (frame) => picture(room(frame < 24 ? 0 : 7, frame / 20))).map((one, i) =>
    finder.next(one, i / 20),
  );
  expect(told.flatMap((is, i) => (is ? [i] : []))).toEqual([24]);
});

it('finds one that is hidden by black pictures, and none in a room that goes dark for a moment', () => {
  const dark = picture(() => 0.01);
  const after = (aside: number): Grey[] =>
    frames(60, (frame) =>
      frame >= 20 && frame < 26 ? dark : picture(room(frame < 20 ? 0 : aside, frame / 20)),
    );
  expect(cutsIn(after(7))).toEqual([26 / 20]);
  expect(cutsIn(after(0))).toEqual([]);
});

it.each([
  [
    'a camera that begins to pan quickly',
    (frame: number) => room(Math.max(0, frame - 20) * 0.12, frame / 20),
  ],
  ['a dancer alone', (frame: number) => room(0, frame / 20)],
  ['lamps that flash', (frame: number) => room(0, frame / 20, frame % 7 === 0 ? 0.55 : 0)],
  ['lamps that blink', (frame: number) => room(0, frame / 20, frame % 8 < 4 ? 0.5 : -0.4)],
  ['a single wrong picture', (frame: number) => room(frame === 20 ? 7 : 0, frame / 20)],
])('%s is no cut', (_, grey) => {
  expect(cutsIn(frames(60, (frame) => picture(grey(frame))))).toEqual([]);
});
