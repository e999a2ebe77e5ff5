import { describe, expect, test } from 'vitest';
import { eulerZxy } from '../../../../web/motion/math/euler';
import { aboutAxis, multiply, type Quat, quatDot } from '../../../../web/motion/math/quat';
import type { Vec3 } from '../../../../web/motion/math/vec3';
import { random } from '../../support/made-dancer';

/** The rotation that angles z, x, y write, as a reader of the file composes it. */
function composed([z, x, y]: Vec3): Quat {
  const tilt = multiply(aboutAxis([1, 0, 0], x), aboutAxis([0, 1, 0], y));
  return multiply(aboutAxis([0, 0, 1], z), tilt);
}

describe('Euler angles in the order Z X Y', () => {
  test('represent every rotation', () => {
    const draw = random(5);
    let before: Vec3 = [0, 0, 0];
    for (let i = 0; i < 500; i++) {
      const axis = [draw() - 0.5, draw() - 0.5, draw() - 0.5] as const;
      const size = Math.hypot(...axis);
      const q = aboutAxis([axis[0] / size, axis[1] / size, axis[2] / size], 7 * draw());
      before = eulerZxy(q, before);
      expect(Math.abs(quatDot(q, composed(before)))).toBeCloseTo(1, 10);
    }
  });

  test('are unwrapped: a somersault is one growing angle', () => {
    let before: Vec3 = [0, 0, 0];
    for (let i = 1; i <= 200; i++) {
      const angle = i * 0.05;
      before = eulerZxy(aboutAxis([1, 0, 0], angle), before);
      expect(before[1]).toBeCloseTo(angle, 6);
      expect(Math.abs(before[0]) + Math.abs(before[2])).toBeLessThan(1e-6);
    }
  });

  test('stay near the frame before at the gimbal lock', () => {
    for (const sign of [1, -1]) {
      const angles = eulerZxy(composed([0.7, (sign * Math.PI) / 2, 0.4]), [0.69, sign * 1.5, 0.41]);
      expect(angles[0]).toBeCloseTo(0.69, 1);
      expect(angles[2]).toBeCloseTo(0.41, 6);
      expect(Math.abs(quatDot(composed(angles), composed([0.7, (sign * Math.PI) / 2, 0.4])))).toBeCloseTo(
        1,
        10,
      );
    }
  });
});
