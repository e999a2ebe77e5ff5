import { DirectionalLight, Group, HemisphereLight } from 'three';
import type { Look } from './theme';

/**
 * Key, fill, rim and hemisphere lights. All but the hemisphere keep their angles to the camera, so that the couple
 * always has light and shade. There is no environment map: filtering one blocks the page for seconds without a graphics card, and
 * on a matt body a fill light does the same.
 */
interface Lights {
  readonly object: Group;
  /** Places the lights around the couple for a camera that looks along `heading` (radians about y). */
  place(x: number, z: number, heading: number): void;
  setLook(look: Look): void;
  dispose(): void;
}

/** Angle of the key light to the right of the camera, radians. */
const KEY_ANGLE = (43 * Math.PI) / 180;
const KEY_HEIGHT = 5.4;
const KEY_DISTANCE = 4.2;
/** Half the width of the area that casts shadows, metres. */
const SHADOW_HALF_WIDTH = 2.6;
/**
 * Texels along a side of the shadow map: 3.3 cm each, half of what the blur spreads them over. Finer ones make no visible difference,
 * and without a graphics card they take longer than the rest of the picture.
 */
const SHADOW_TEXELS = 160;
/** Radius of the blur, texels. */
const BLUR_TEXELS = 2;

export function createLights(): Lights {
  const hemisphere = new HemisphereLight();
  const key = new DirectionalLight(0xfff3e4);
  const coolRim = new DirectionalLight(0xdbe9f5);
  const warmRim = new DirectionalLight(0xffe2c4);
  const fill = new DirectionalLight(0xe6eefc);
  const object = new Group();
  object.add(hemisphere);
  for (const light of [key, fill, coolRim, warmRim]) object.add(light, light.target);

  key.castShadow = true;
  key.shadow.mapSize.set(SHADOW_TEXELS, SHADOW_TEXELS);
  key.shadow.radius = BLUR_TEXELS;
  // One sample in the middle of every texel: between two texels it would depend on rounding.
  key.shadow.blurSamples = 2 * BLUR_TEXELS + 1;
  key.shadow.bias = -0.001;
  key.shadow.normalBias = 0.035;
  Object.assign(key.shadow.camera, {
    left: -SHADOW_HALF_WIDTH,
    right: SHADOW_HALF_WIDTH,
    top: SHADOW_HALF_WIDTH,
    bottom: -SHADOW_HALF_WIDTH,
    near: 1,
    far: 14,
  });
  key.shadow.camera.updateProjectionMatrix();

  const placeLight = (
    light: DirectionalLight,
    x: number,
    z: number,
    angle: number,
    distance: number,
    height: number,
  ): void => {
    light.position.set(x + Math.sin(angle) * distance, height, z + Math.cos(angle) * distance);
    light.target.position.set(x, 0.8, z);
    light.target.updateMatrixWorld();
  };

  return {
    object,
    place(x, z, heading) {
      placeLight(key, x, z, heading + KEY_ANGLE, KEY_DISTANCE, KEY_HEIGHT);
      placeLight(fill, x, z, heading - 0.9, 4, 1.6);
      placeLight(warmRim, x, z, heading + Math.PI * 0.78, 4, 2.6);
      placeLight(coolRim, x, z, heading - Math.PI * 0.78, 4, 3.2);
    },
    setLook(look) {
      hemisphere.color.set(look.sky);
      hemisphere.groundColor.set(look.ground);
      hemisphere.intensity = look.hemisphere;
      key.intensity = look.key;
      coolRim.intensity = look.rim;
      warmRim.intensity = look.rim * 0.45;
      fill.intensity = look.fill;
    },
    dispose() {
      key.dispose();
      fill.dispose();
      coolRim.dispose();
      warmRim.dispose();
      hemisphere.dispose();
    },
  };
}
