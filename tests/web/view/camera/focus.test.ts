import { describe, expect, it } from 'vitest';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { focusShot } from '../../../../web/view/camera/focus';
import { FIELD_OF_VIEW, measureCouple } from '../../../../web/view/camera/framing';

/** Joints of a dancer at (x, 0), the head at 1.5 m. */
function figure(x: number): Float32Array {
  const joints = new Float32Array(JOINT_COUNT * 3);
  for (let joint = 0; joint < JOINT_COUNT; joint++) joints.set([x, 1, 0], joint * 3);
  joints[J.head * 3 + 1] = 1.5;
  for (const toe of [J.left_foot, J.right_foot, J.left_ankle, J.right_ankle]) joints[toe * 3 + 1] = 0.05;
  return joints;
}

const made = figure(-0.5);
const couple = measureCouple([figure(0.5), made]);
/** Half the height and half the width of what is seen around the target, metres. */
const seen = (distance: number, aspect: number): readonly [number, number] => {
  const half = distance * Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
  return [half, half * aspect];
};

describe('a detail in the picture', () => {
  it.each([0.6, 1, 1.8])(
    'is the feet of the dancer that was made, close and low, at a shape of %s',
    (aspect) => {
      const { target, distance, heading, elevation } = focusShot('feet', made, couple, aspect, 0.3);
      expect(target[0]).toBeCloseTo(-0.5, 5);
      const [high, wide] = seen(distance, aspect);
      expect(target[1] - high).toBeLessThan(0);
      expect(wide).toBeGreaterThan(0.5);
      expect(high).toBeLessThan(1.1);
      expect(heading).toBe(0.3);
      expect(elevation).toBeLessThan(0.4);
    },
  );

  it('is both trunks between hips and heads, closer than the couple', () => {
    const trunks = focusShot('trunks', made, couple, 1.6, 0.3);
    const whole = focusShot('couple', made, couple, 1.6, 0.3);
    expect(trunks.distance).toBeLessThan(0.8 * whole.distance);
    const [high, wide] = seen(trunks.distance, 1.6);
    expect(trunks.target[1] + high).toBeGreaterThan(1.7);
    expect(wide).toBeGreaterThan(0.9);
  });
});
