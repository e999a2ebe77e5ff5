import { PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { screenBounds } from '../../../web/view/edge-smoothing';

const PICTURE = { left: 100, bottom: 20, width: 400, height: 300 };

function camera(shift = 0): PerspectiveCamera {
  const eye = new PerspectiveCamera(40, PICTURE.width / PICTURE.height, 0.1, 50);
  eye.position.set(1, 1.5, 6);
  eye.lookAt(0, 0.9, 0);
  if (shift) eye.setViewOffset(PICTURE.width, PICTURE.height, -shift, 0, PICTURE.width, PICTURE.height);
  eye.updateMatrixWorld();
  return eye;
}

/** Where a point of the room is in the picture. */
function seen(eye: PerspectiveCamera, point: readonly [number, number, number]): [number, number] {
  const { x, y } = new Vector3(...point).project(eye);
  return [PICTURE.left + ((x + 1) / 2) * PICTURE.width, PICTURE.bottom + ((y + 1) / 2) * PICTURE.height];
}

describe('screenBounds', () => {
  it.each([0, 60])(
    'contains a margin around every joint, and little more (picture shifted by %i pixels)',
    (shift) => {
      const eye = camera(shift);
      const joints = [Float32Array.of(-0.4, 0.1, 0, 0.3, 1.6, 0.4), Float32Array.of(0.9, 1, -0.5)];
      const rect = screenBounds(joints, eye, PICTURE, 0.2)!;
      const right = eye.matrixWorld.elements.slice(0, 3);
      for (const list of joints) {
        for (let at = 0; at < list.length; at += 3) {
          for (const side of [-0.2, 0.2]) {
            const [x, y] = seen(eye, [
              list[at]! + side * right[0]!,
              list[at + 1]! + side * right[1]!,
              list[at + 2]! + side * right[2]!,
            ]);
            expect(x).toBeGreaterThanOrEqual(rect.left - 1e-3);
            expect(x).toBeLessThanOrEqual(rect.left + rect.width + 1e-3);
            expect(y).toBeGreaterThanOrEqual(rect.bottom);
            expect(y).toBeLessThanOrEqual(rect.bottom + rect.height);
          }
        }
      }
      expect(rect.width).toBeLessThan(0.6 * PICTURE.width);
    },
  );

  it('is clipped to the picture', () => {
    const rect = screenBounds([Float32Array.of(-30, 1, 0, 30, 1, 0)], camera(), PICTURE, 0.2)!;
    expect(rect.left).toBe(PICTURE.left);
    expect(rect.width).toBe(PICTURE.width);
    expect(rect.height).toBeLessThan(PICTURE.height);
  });

  it('is null without dancers, or with none in the picture', () => {
    expect(screenBounds([], camera(), PICTURE, 0.2)).toBeNull();
    expect(screenBounds([Float32Array.of(30, 1, 0)], camera(), PICTURE, 0.2)).toBeNull();
  });

  it('covers the picture for a dancer at the camera', () => {
    const rect = screenBounds([Float32Array.of(1, 1.5, 6.1)], camera(), PICTURE, 0.2);
    expect(rect?.width).toBe(PICTURE.width);
  });
});
