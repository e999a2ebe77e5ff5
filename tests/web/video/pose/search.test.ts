import { describe, expect, it } from 'vitest';
import type { Person } from '../../../../web/video/pose/detector';
import {
  squareOfReach,
  squaresAbout,
  squaresOver,
  standingAt,
  wholePicture,
  withinReach,
} from '../../../../web/video/pose/search';

const at = (x: number, size = 200): Person => ({
  score: 1,
  box: [x - 10, 0, x + 10, 20],
  region: { x, y: 200, size, angle: 0 },
});

describe('squares', () => {
  it.each([
    [1920, 1080],
    [1080, 1920],
    [2560, 480],
    [400, 400],
  ])('of a picture of %i x %i cover it, and hold who is half as high as they are whole', (width, height) => {
    for (const squares of squaresOver({ width, height })) {
      const { side } = squares[0]!;
      expect(squares.every((square) => square.side === side)).toBe(true);
      const half = side / 4;
      const holds = (x: number, y: number): boolean =>
        squares.some(
          (square) =>
            Math.abs(square.x + 2 * half - x) <= half + 1e-6 &&
            Math.abs(square.y + 2 * half - y) <= half + 1e-6,
        );
      const cut: string[] = [];
      for (let x = half; x <= width - half; x += 7)
        for (let y = half; y <= height - half; y += 7) if (!holds(x, y)) cut.push(`${x}, ${y}`);
      expect(cut).toEqual([]);
    }
  });

  it('are few: three and ten of a video of 16:9', () => {
    expect(squaresOver({ width: 1920, height: 1080 }).map((squares) => squares.length)).toEqual([3, 10]);
  });

  it('have the picture, or a point of it, in their middle', () => {
    const size = { width: 1920, height: 1080 };
    expect(wholePicture(size)).toEqual({ x: 0, y: -420, side: 1920 });
    expect(squaresAbout({ x: 500, y: 700 }, size)).toEqual([
      { x: -40, y: 160, side: 1080 },
      { x: 140, y: 340, side: 720 },
      { x: 320, y: 520, side: 360 },
    ]);
  });
});

describe('a person who was lost', () => {
  const last = { region: { x: 100, y: 200, size: 200, angle: 0 }, time: 3 };

  it('is found near where they were, and not whoever else is in the picture', () => {
    const [dancer, bystander] = [at(160), at(600)];
    expect(withinReach([bystander, dancer], last, 3.1)).toEqual([dancer]);
    expect(withinReach([bystander], last, 3.1)).toEqual([]);
    // After three seconds they may have come from there.
    expect(withinReach([bystander, dancer], last, 6)).toEqual([dancer, bystander]);
  });

  it('is looked for in a square that holds all of them wherever they can have gone', () => {
    // The region's middle may be 0.5 + 0.1 regions away, and half a region is around it.
    expect(squareOfReach(last, 3.1)).toEqual({
      x: expect.closeTo(100 - 220) as number,
      y: expect.closeTo(200 - 220) as number,
      side: expect.closeTo(440) as number,
    });
  });
});

it('who stands at a point is the nearest one whose region holds it', () => {
  const [small, large] = [at(300, 100), at(340, 400)];
  expect(standingAt([large, small], { x: 310, y: 210 })).toEqual([small, large]);
  expect(standingAt([large, small], { x: 400, y: 200 })).toEqual([large]);
  expect(standingAt([large, small], { x: 700, y: 200 })).toEqual([]);
});
