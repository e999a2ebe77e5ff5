import { DirectionalLight, Group, HemisphereLight } from 'three';
import type { Look } from './theme';

/**
 * Key, fill, rims and sky. All but the sky keep their angles to the camera, so that the couple is
 * always modelled. There is no environment map: filtering one blocks the page for seconds without a graphics card, and
 * on a matt body a fill light does the same.
 */
export interface Lights {
  readonly object: Group;
  /** Places the lights around the couple for a camera that looks along `heading` (radians about y). */
  aim(x: number, z: number, heading: number): void;
  setLook(look: Look): void;
  dispose(): void;
}

/** Angle of the key light to the right of the camera, radians. */
const KEY_ANGLE = (43 * Math.PI) / 180;
const KEY_HEIGHT = 5.4;
const KEY_DISTANCE = 4.2;
/** Half the width of what casts shadows, metres. */
const SHADOW_REACH = 2.6;
/**
 * Texels along a side of the shadow map: 3.3 cm each, half of what the blur spreads them over. Finer ones are not seen,
 * and without a graphics card they take longer than the rest of the picture.
 */
const SHADOW_TEXELS = 160;
/** How far the blur goes to each side, texels. */
const BLUR = 2;

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
  key.shadow.radius = BLUR;
  // One sample in the middle of every texel: between two texels, rounding would choose.
  key.shadow.blurSamples = 2 * BLUR + 1;
  key.shadow.bias = -0.001;
  key.shadow.normalBias = 0.035;
  Object.assign(key.shadow.camera, {
    left: -SHADOW_REACH,
    right: SHADOW_REACH,
    top: SHADOW_REACH,
    bottom: -SHADOW_REACH,
    near: 1,
    far: 14,
  });
  key.shadow.camera.updateProjectionMatrix();

  const around = (
    light: DirectionalLight,
    x: number,
    z: number,
    angle: number,
    away: number,
    up: number,
  ): void => {
    light.position.set(x + Math.sin(angle) * away, up, z + Math.cos(angle) * away);
    light.target.position.set(x, 0.8, z);
    light.target.updateMatrixWorld();
  };

  return {
    object,
    aim(x, z, heading) {
      around(key, x, z, heading + KEY_ANGLE, KEY_DISTANCE, KEY_HEIGHT);
      around(fill, x, z, heading - 0.9, 4, 1.6);
      around(warmRim, x, z, heading + Math.PI * 0.78, 4, 2.6);
      around(coolRim, x, z, heading - Math.PI * 0.78, 4, 3.2);
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
