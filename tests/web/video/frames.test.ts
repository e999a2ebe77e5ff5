import { expect, test } from 'vitest';
import { pictureChoice } from '../../../web/video/frames';

/** Pictures that are read of ten seconds, whose times vary by up to 3 ms to either side. */
function read(fps: number): number {
  const times = Array.from({ length: 10 * fps }, (_, i) => i / fps + 0.003 * Math.sin(2.7 * i));
  return times.filter(pictureChoice()).length;
}

test.each([10, 24, 25, 30])('every picture of a video of %i a second is read', (fps) => {
  expect(read(fps)).toBe(10 * fps);
});

test.each([40, 48, 50, 60, 90, 120, 240])('of %i pictures a second at most 30 are read', (fps) => {
  expect(read(fps)).toBeLessThanOrEqual(301);
  expect(read(fps)).toBeGreaterThan(200);
});
