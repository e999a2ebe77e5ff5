import { describe, expect, test } from 'vitest';
import { timingOf, type Tracks, valueAt } from '../../../../../web/motion/import/gltf/animation';
import { aboutAxis } from '../../../../../web/motion/math/quat';
import { X_AXIS } from '../../../../../web/motion/math/vec3';

const track = (
  times: readonly number[],
  values: readonly number[],
  width: number,
  interpolation: string,
) => ({
  times: Float32Array.from(times),
  values: Float32Array.from(values),
  width,
  interpolation,
});

describe('between two keys', () => {
  test('of a cubic spline lies the cubic of their values and of the tangents between them', () => {
    // t^3 - t + 1 from 0 to 2 seconds, whose slopes are -1 and 11 a second; the outer tangents are not its own.
    const keys = [99, 99, 99, 1, 1, 1, -1, -1, -1, 11, 11, 11, 7, 7, 7, 99, 99, 99];
    const cubic = track([0, 2], keys, 3, 'CUBICSPLINE');
    for (const t of [0, 0.5, 1, 1.7, 2])
      for (const value of valueAt(cubic, t)) expect(value).toBeCloseTo(t ** 3 - t + 1, 4);
  });

  test('of a cubic spline a rotation is one, and that of a line turns evenly', () => {
    const [from, to] = [aboutAxis(X_AXIS, 0), aboutAxis(X_AXIS, 2)];
    const none = [0, 0, 0, 0];
    const cubic = track([0, 1], [...none, ...from, ...none, ...none, ...to, ...none], 4, 'CUBICSPLINE');
    expect(Math.hypot(...valueAt(cubic, 0.5))).toBeCloseTo(1, 6);
    const line = track([0, 1], [...from, ...to], 4, 'LINEAR');
    valueAt(line, 0.25).forEach((value, i) => {
      expect(value).toBeCloseTo(aboutAxis(X_AXIS, 0.5)[i]!, 6);
    });
  });
});

test('two keys that are near each other say nothing of the frame rate', () => {
  const still = [0, 0, 0];
  const dance = Array.from({ length: 31 }, (_, i) => i / 30);
  const tracks: Tracks = new Map([
    [
      '0 translation',
      track(
        dance,
        dance.flatMap(() => still),
        3,
        'LINEAR',
      ),
    ],
    ['1 scale', track([0, 1 / 60], [...still, ...still], 3, 'LINEAR')],
  ]);
  expect(timingOf(tracks)).toEqual({ start: 0, frames: 31, fps: 30 });
});
