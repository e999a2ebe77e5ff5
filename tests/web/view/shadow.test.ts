import { DirectionalLight, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { createFloor } from '../../../web/view/floor';
import { createLights } from '../../../web/view/lights';

/** The one light that casts shadows, aimed at the middle of the floor. */
function keyLight(heading: number): DirectionalLight {
  const lights = createLights();
  lights.place(0, 0, heading);
  lights.object.updateMatrixWorld(true);
  const casting = lights.object.children.filter((light) => light.castShadow);
  expect(casting).toHaveLength(1);
  const key = casting[0];
  if (!(key instanceof DirectionalLight)) throw new Error('The key light is not directional.');
  key.shadow.updateMatrices(key);
  return key;
}

it('blurs shadows with few enough texture reads for a software renderer', () => {
  const { mapSize, blurSamples, radius } = keyLight(0).shadow;
  expect(2 * mapSize.x * mapSize.y * blurSamples).toBeLessThan(1_000_000);
  // A step of a whole texel from sample to sample: neither gaps nor a choice between two texels.
  expect((2 * radius) / (blurSamples - 1)).toBe(1);
});

it('draws the floor once, as far as a shadow can fall, from wherever the light comes', () => {
  const floor = createFloor();
  floor.setCentre(0, 0);
  expect(floor.object.children).toHaveLength(0);
  expect(floor.object.receiveShadow).toBe(true);
  floor.object.geometry.computeBoundingSphere();
  const { radius } = floor.object.geometry.boundingSphere!;
  for (const heading of [0, 1, 2.5, 4]) {
    const { camera } = keyLight(heading).shadow;
    for (const [x, y] of [
      [-1, -1],
      [-1, 1],
      [1, -1],
      [1, 1],
    ] as const) {
      const near = new Vector3(x, y, -1).unproject(camera);
      const far = new Vector3(x, y, 1).unproject(camera);
      const at = near.lerp(far, (floor.object.position.y - near.y) / (far.y - near.y));
      expect(Math.hypot(at.x, at.z)).toBeLessThan(radius);
    }
  }
});
