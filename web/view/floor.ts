import {
  CircleGeometry,
  Color,
  LinearSRGBColorSpace,
  Mesh,
  ShaderMaterial,
  UniformsLib,
  UniformsUtils,
  Vector2,
} from 'three';
import type { Look } from './theme';

/** The floor: lit in the middle, with a grid that fades out and the shadows that fall on it, in one pass. */
interface Floor {
  readonly object: Mesh;
  /** Keeps the lit part under the couple (x, z in metres); the grid stays where it is. */
  setCentre(x: number, z: number): void;
  setLook(look: Look): void;
  dispose(): void;
}

/**
 * Radius of the floor, metres. Where the grid ends it has faded into the background's colour, and the shadow map is
 * smaller.
 */
const RADIUS = 5.4;
const SEGMENTS = 64;

const VERTEX = /* glsl */ `
#include <common>
#include <shadowmap_pars_vertex>
varying vec2 vPlace;
void main() {
  vec3 transformedNormal = normalMatrix * normal;
  vec4 worldPosition = modelMatrix * vec4(position, 1.0);
  vPlace = worldPosition.xz;
  gl_Position = projectionMatrix * viewMatrix * worldPosition;
  #include <shadowmap_vertex>
}`;

// Colours are mixed as they are seen (sRGB), like those of the interface around the stage.
const FRAGMENT = /* glsl */ `
uniform vec3 background;
uniform vec3 litFloor;
uniform vec3 line;
uniform float lineOpacity;
uniform float shadow;
uniform vec2 centre;
varying vec2 vPlace;

#include <common>
#include <lights_pars_begin>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>

// Coverage of lines 'spacing' apart, as wide as 'width' metres but never thinner than a pixel shows.
float lines(float spacing, float width) {
  vec2 at = vPlace / spacing;
  vec2 pixel = fwidth(at);
  vec2 wide = max(vec2(width / spacing), pixel);
  vec2 toLine = abs(fract(at - 0.5) - 0.5);
  // A line thinner than a pixel is drawn a pixel wide and as much fainter.
  vec2 cover = (1.0 - smoothstep(wide - pixel, wide + pixel, toLine * 2.0)) * min(width / spacing / pixel, 1.0);
  return max(cover.x, cover.y);
}

// Dithering: noise of half a step hides the steps of an 8 bit gradient (interleaved gradient noise, Jimenez 2014).
float noise(vec2 p) {
  return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main() {
  float fromCentre = distance(vPlace, centre);
  float light = 1.0 - smoothstep(0.0, 5.0, fromCentre);
  vec3 colour = mix(background, litFloor, light);
  float strength = max(lines(1.0, 0.009), 0.5 * lines(0.5, 0.007)) * lineOpacity;
  colour = mix(colour, line, strength * (1.0 - smoothstep(1.6, ${RADIUS.toFixed(1)}, fromCentre)));
  colour *= 1.0 - shadow * (1.0 - getShadowMask());
  gl_FragColor = vec4(colour + noise(gl_FragCoord.xy) / 255.0, 1.0);
}`;

export function createFloor(): Floor {
  const circle = new CircleGeometry(RADIUS, SEGMENTS).rotateX(-Math.PI / 2);
  const own = {
    background: { value: new Color() },
    litFloor: { value: new Color() },
    line: { value: new Color() },
    lineOpacity: { value: 0 },
    shadow: { value: 0 },
    centre: { value: new Vector2() },
  };
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    // three.js fills in the uniforms of the lights, of which only the shadow is used.
    uniforms: { ...UniformsUtils.clone(UniformsLib.lights), ...own },
    lights: true,
  });
  const object = new Mesh(circle, material);
  object.receiveShadow = true;
  return {
    object,
    setCentre(x, z) {
      own.centre.value.set(x, z);
      object.position.set(x, 0, z);
    },
    setLook(look) {
      own.background.value.setHex(look.background, LinearSRGBColorSpace);
      own.litFloor.value.setHex(look.litFloor, LinearSRGBColorSpace);
      own.line.value.setHex(look.line, LinearSRGBColorSpace);
      own.lineOpacity.value = look.lineOpacity;
      own.shadow.value = look.shadow;
    },
    dispose() {
      circle.dispose();
      material.dispose();
    },
  };
}
