import { expect, it } from 'vitest';
import { placeOf } from '../../../web/view/canvas';

it.each([0.5, Math.SQRT1_2, 1, 1.25, 1.5, 2])(
  'the halves of a split view cover all pixels of the canvas, at %f pixels along a CSS pixel',
  (ratio) => {
    for (let width = 100; width < 1500; width++) {
      const [left, right] = [
        placeOf('left', { width, height: 100 }, ratio),
        placeOf('right', { width, height: 100 }, ratio),
      ];
      // As three.js rounds them, and the canvas.
      const begins = Math.floor(right.left * ratio);
      expect(Math.floor(left.width * ratio)).toBeGreaterThanOrEqual(begins);
      expect(begins + Math.floor(right.width * ratio)).toBeGreaterThanOrEqual(Math.floor(width * ratio));
      expect((right.width - left.width) * ratio).toBeCloseTo(1);
    }
  },
);
