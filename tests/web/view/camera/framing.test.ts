import { describe, expect, it } from 'vitest';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import {
  FIELD_OF_VIEW,
  fitDistance,
  isFar,
  MAX_DISTANCE,
  measureCouple,
  nearestAngle,
  reframed,
  shotOf,
} from '../../../../web/view/camera/framing';

/** Joints of a dancer at (x, z): all on a vertical line, but for hips across x. */
function figure(x: number, z: number): Float32Array {
  const joints = new Float32Array(JOINT_COUNT * 3);
  for (let j = 0; j < JOINT_COUNT; j++) joints.set([x, 0.05 * j, z], j * 3);
  joints[J.left_hip * 3]! += 0.1;
  joints[J.right_hip * 3]! -= 0.1;
  return joints;
}

describe('framing', () => {
  it('looks square to the line between the roots, with the leader on the right', () => {
    for (const angle of [0, 0.7, 2, 3.1, -1.2]) {
      const leader = figure(3 + Math.cos(angle), 1 + Math.sin(angle));
      const reactor = figure(3, 1);
      const { sideHeading } = measureCouple([leader, reactor]);
      const eye = [Math.sin(sideHeading), Math.cos(sideHeading)] as const;
      const right = [Math.cos(sideHeading), -Math.sin(sideHeading)] as const;
      expect(eye[0] * Math.cos(angle) + eye[1] * Math.sin(angle)).toBeCloseTo(0, 5);
      expect(right[0] * Math.cos(angle) + right[1] * Math.sin(angle)).toBeCloseTo(1, 5);
    }
  });

  it('sees a dancer alone from the front', () => {
    const { sideHeading } = measureCouple([figure(0, 0)]);
    expect(Math.cos(sideHeading)).toBeGreaterThan(0.7);
    expect(Math.abs(Math.sin(sideHeading)), 'not head-on').toBeGreaterThan(0.3);
  });

  it('measures the middle and the radius of the couple', () => {
    const couple = measureCouple([figure(1, 0), figure(-1, 2)]);
    expect(couple.x).toBeCloseTo(0, 6);
    expect(couple.z).toBeCloseTo(1, 6);
    expect(couple.radius).toBeGreaterThan(Math.SQRT2 - 1e-6);
    expect(couple.radius).toBeLessThan(1.6);
  });

  it('has room for other dancers beside them, but stays with the couple', () => {
    const [leader, reactor] = [figure(0.3, 0), figure(-0.3, 0)];
    const { x, radius } = measureCouple([leader, reactor], [figure(3, 0)]);
    expect(x).toBeCloseTo(0, 6);
    expect(radius).toBeGreaterThan(2.9);
  });

  it('keeps both dancers inside the picture, wide or narrow, heads and feet too, from any side, as far as it goes back', () => {
    const tangent = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    for (const aspect of [0.5, 1, 1.8])
      for (const apart of [0.4, 1, 2.2])
        for (const tall of [1, 1.3]) {
          const dancers = [figure(apart, 0), figure(-apart, 0)].map((joints) =>
            joints.map((value, i) => (i % 3 === 1 ? value * tall * 1.6 : value)),
          );
          const couple = measureCouple(dancers);
          for (const heading of [0, 0.6, Math.PI / 2]) {
            const { distance, elevation } = shotOf('orbit', couple, aspect, heading);
            if (distance === MAX_DISTANCE) continue;
            for (const joints of dancers)
              for (let j = 0; j < joints.length; j += 3) {
                const [x, y, z] = [joints[j]!, joints[j + 1]! - 0.84, joints[j + 2]!];
                const near = x * Math.sin(heading) + z * Math.cos(heading);
                const depth = distance - near * Math.cos(elevation) - y * Math.sin(elevation);
                const up = y * Math.cos(elevation) - near * Math.sin(elevation);
                const across = x * Math.cos(heading) - z * Math.sin(heading);
                // A skull is higher than its joint.
                if (j === 3 * J.head) expect((up + 0.2) / depth / tangent).toBeLessThan(1);
                // So is a sole below its own, here the lowest.
                if (j === 0) expect((up - 0.05) / depth / tangent).toBeGreaterThan(-1);
                expect(Math.abs(across) / depth / tangent / aspect).toBeLessThan(1);
              }
          }
        }
    expect(fitDistance(measureCouple([figure(0.2, 0), figure(-0.2, 0)]), 1.6)).toBeCloseTo(5.05, 5);
    // A distance that the controls do not take would be asked for in every frame.
    expect(fitDistance(measureCouple([figure(4, 0), figure(-4, 0)]), 0.5)).toBe(MAX_DISTANCE);
  });

  it('looks straight down from the top and level from the side', () => {
    const couple = measureCouple([figure(0.4, 0), figure(-0.4, 0)]);
    expect(shotOf('top', couple, 1.6, 0).elevation).toBeGreaterThan(1.5);
    expect(shotOf('side', couple, 1.6, 2).elevation).toBeLessThan(0.1);
    expect(shotOf('side', couple, 1.6, 2).heading).toBeCloseTo(couple.sideHeading, 6);
    expect(shotOf('follow', couple, 1.6, 2).heading).toBe(2);
  });

  it('takes the nearest of equal angles', () => {
    expect(nearestAngle(Math.PI * 1.9, 0)).toBeCloseTo(-Math.PI * 0.1, 6);
    expect(nearestAngle(-3, 3)).toBeCloseTo(2 * Math.PI - 3, 6);
    expect(nearestAngle(0.2, 0.1)).toBeCloseTo(0.2, 6);
  });

  it('frames the couple alike elsewhere and in a picture of another shape', () => {
    const couple = measureCouple([figure(0.4, 0), figure(-0.4, 0)]);
    const there = measureCouple([figure(3.4, 2), figure(2.6, 2)]);
    const shot = { target: [0.1, 1, -0.2], distance: 3, heading: 0.7, elevation: 0.3 } as const;
    const wide = {
      view: 'orbit',
      shot,
      tracked: [0, 0],
      ownDistance: true,
      ownHeading: true,
      aspect: 1.8,
    } as const;
    expect(reframed(wide, there, 1.8)).toEqual({ ...shot, target: [3.1, 1, 1.8] });
    // Narrower: what was seen at the sides still is. Wider: as high as before.
    expect(reframed(wide, couple, 0.9).distance).toBeCloseTo(6, 6);
    expect(reframed(wide, couple, 2.4).distance).toBe(3);
    expect(reframed({ ...wide, ownDistance: false }, couple, 0.9).distance).toBe(fitDistance(couple, 0.9));
    const top = { ...wide, view: 'top' } as const;
    expect(reframed(top, couple, 1.8).distance).toBeCloseTo(3, 6);
    const [narrow, before] = [0.6, 1.8].map((aspect) => shotOf('top', couple, aspect, 0).distance);
    expect(narrow).toBeGreaterThan(before! + 0.5);
    expect(reframed(top, couple, 0.6).distance).toBeCloseTo((3 * narrow!) / before!, 6);
  });

  it('is far where bodies are small, and not near the eye or on many pixels', () => {
    const couple = measureCouple([figure(0.3, 0), figure(-0.3, 0)]);
    const eye = (z: number) => ({ x: 0, y: 0.84, z });
    expect(isFar(eye(5), couple, 360)).toBe(true);
    expect(isFar(eye(5), couple, 1080)).toBe(false);
    expect(isFar(eye(1.5), couple, 360)).toBe(false);
    expect(isFar(eye(20), couple, 1080)).toBe(true);
    // The dancer nearer to the eye decides.
    const wide = measureCouple([figure(0, 2), figure(0, -2)]);
    expect(isFar(eye(5), wide, 400)).toBe(false);
    expect(isFar(eye(5), couple, 400)).toBe(true);
  });
});
