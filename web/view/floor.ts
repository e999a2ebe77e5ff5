import {
  Color,
  Group,
  LinearSRGBColorSpace,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  ShadowMaterial,
  Vector2,
} from 'three';
import { SOLE } from './body/leg';
import type { Look } from './theme';

/** The studio floor: a pool of light with a fading grid, and the shadows that fall on it. */
export interface Floor {
  readonly object: Group;
  /** Keeps the pool of light under the couple (x, z in metres); the grid stays where it is. */
  setCentre(x: number, z: number): void;
  setLook(look: Look): void;
  dispose(): void;
}

/** Radius of the floor that is drawn at all, metres; beyond the pool it is the background's colour. */
const REACH = 24;

const VERTEX = /* glsl */ `
varying vec2 vPlace;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vPlace = world.xz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

// Colours are mixed as they are seen (sRGB), like those of the interface around the stage.
const FRAGMENT = /* glsl */ `
uniform vec3 background;
uniform vec3 pool;
uniform vec3 line;
uniform float lineOpacity;
uniform vec2 centre;
varying vec2 vPlace;

// Coverage of lines 'spacing' apart, as wide as 'width' metres but never thinner than a pixel shows.
float lines(float spacing, float width) {
  vec2 at = vPlace / spacing;
  vec2 pixel = fwidth(at);
  vec2 wide = max(vec2(width / spacing), pixel);
  vec2 away = abs(fract(at - 0.5) - 0.5);
  // A line thinner than a pixel is drawn a pixel wide and as much fainter.
  vec2 cover = (1.0 - smoothstep(wide - pixel, wide + pixel, away * 2.0)) * min(width / spacing / pixel, 1.0);
  return max(cover.x, cover.y);
}

// A half step of noise hides the steps of an 8 bit gradient.
float noise(vec2 p) {
  return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main() {
  float away = distance(vPlace, centre);
  float light = 1.0 - smoothstep(0.0, 5.0, away);
  vec3 colour = mix(background, pool, light);
  float strength = max(lines(1.0, 0.009), 0.5 * lines(0.5, 0.007)) * lineOpacity;
  colour = mix(colour, line, strength * (1.0 - smoothstep(1.6, 5.4, away)));
  gl_FragColor = vec4(colour + noise(gl_FragCoord.xy) / 255.0, 1.0);
}`;

export function createFloor(): Floor {
  const plane = new PlaneGeometry(2 * REACH, 2 * REACH).rotateX(-Math.PI / 2);
  const uniforms = {
    background: { value: new Color() },
    pool: { value: new Color() },
    line: { value: new Color() },
    lineOpacity: { value: 0 },
    centre: { value: new Vector2() },
  };
  const ground = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms });
  const shade = new ShadowMaterial({ depthWrite: false });
  const groundMesh = new Mesh(plane, ground);
  const shadeMesh = new Mesh(plane, shade);
  shadeMesh.receiveShadow = true;
  shadeMesh.position.y = 0.002;
  const object = new Group();
  object.add(groundMesh, shadeMesh);
  // Toe joints rest at height 0; the sole is a little below them.
  object.position.y = -SOLE;
  return {
    object,
    setCentre(x, z) {
      uniforms.centre.value.set(x, z);
      groundMesh.position.set(x, 0, z);
      shadeMesh.position.set(x, shadeMesh.position.y, z);
    },
    setLook(look) {
      uniforms.background.value.setHex(look.background, LinearSRGBColorSpace);
      uniforms.pool.value.setHex(look.pool, LinearSRGBColorSpace);
      uniforms.line.value.setHex(look.line, LinearSRGBColorSpace);
      uniforms.lineOpacity.value = look.lineOpacity;
      shade.opacity = look.shadow;
    },
    dispose() {
      plane.dispose();
      ground.dispose();
      shade.dispose();
    },
  };
}
