import {
  Color,
  type Material,
  MeshStandardMaterial,
  ShaderMaterial,
  UniformsLib,
  UniformsUtils,
} from 'three';

/** What the skin of a solid body is painted with: matt, lit by the stage's lights, in one colour. */
export interface Paint {
  readonly material: Material;
  setTint(tint: number): void;
}

const ROUGHNESS = 0.62;

/** Lit at every pixel, as a graphics card does it in no time. */
export function pixelPaint(): Paint {
  const material = new MeshStandardMaterial({ roughness: ROUGHNESS, metalness: 0, vertexColors: true });
  return { material, setTint: (tint) => material.color.set(tint) };
}

// The same light on the same matt skin as `pixelPaint`'s (three.js: GGX over Lambert, 4 % facing), but for what bounces
// more than once.
const VERTEX = /* glsl */ `
uniform vec3 tint;
varying vec3 vLit;
varying vec3 vKeyLit;

#include <common>
#include <color_pars_vertex>
#include <skinning_pars_vertex>
#include <lights_pars_begin>
#include <shadowmap_pars_vertex>

const float ALPHA = ${(ROUGHNESS ** 2).toFixed(6)};
const float ALPHA2 = ALPHA * ALPHA;

vec3 lit(DirectionalLight light, vec3 normal, vec3 view, float facing, vec3 albedo) {
  float towards = dot(normal, light.direction);
  if (towards <= 0.0) return vec3(0.0);
  vec3 halfway = normalize(light.direction + view);
  float shiny = dot(normal, halfway);
  float spread = shiny * shiny * (ALPHA2 - 1.0) + 1.0;
  float past = 1.0 - saturate(dot(view, halfway));
  float mirrored = 0.04 + 0.96 * past * past * past * past * past;
  // Smith's shadowing as Hammon (2017) approximates it, without roots.
  float seen = mix(2.0 * towards * facing, towards + facing, ALPHA);
  float highlight = mirrored * ALPHA2 * RECIPROCAL_PI * 0.5 / max(spread * spread * seen, EPSILON);
  return light.color * towards * (albedo * (1.0 - mirrored) * RECIPROCAL_PI + highlight);
}

void main() {
  #include <color_vertex>
  mat4 bones = skinWeight.x * getBoneMatrix(skinIndex.x) + skinWeight.y * getBoneMatrix(skinIndex.y)
             + skinWeight.z * getBoneMatrix(skinIndex.z) + skinWeight.w * getBoneMatrix(skinIndex.w);
  vec4 worldPosition = modelMatrix * bindMatrixInverse * (bones * (bindMatrix * vec4(position, 1.0)));
  vec3 transformedNormal = normalMatrix * mat3(bones) * normal;
  vec4 mvPosition = viewMatrix * worldPosition;
  gl_Position = projectionMatrix * mvPosition;
  #include <shadowmap_vertex>

  vec3 outwards = normalize(transformedNormal);
  vec3 view = normalize(-mvPosition.xyz);
  float facing = saturate(dot(outwards, view));
  vec3 albedo = tint * vColor.rgb;
  vKeyLit = lit(directionalLights[0], outwards, view, facing, albedo);
  vLit = albedo * RECIPROCAL_PI * 0.96 * getHemisphereLightIrradiance(hemisphereLights[0], outwards);
  for (int i = 1; i < NUM_DIR_LIGHTS; i++) vLit += lit(directionalLights[i], outwards, view, facing, albedo);
}`;

const FRAGMENT = /* glsl */ `
varying vec3 vLit;
varying vec3 vKeyLit;

#include <common>
#include <lights_pars_begin>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>

void main() {
  gl_FragColor = vec4(vLit + vKeyLit * getShadowMask(), 1.0);
  #include <colorspace_fragment>
}`;

/**
 * Lit at the corners of the triangles, its shadows at every pixel: where the processor draws this takes half the time,
 * and pictures are not so large that it shows. The light that casts shadows has to be the only one that does.
 */
export function cornerPaint(): Paint {
  const tinted = { tint: { value: new Color() } };
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...UniformsUtils.clone(UniformsLib.lights), ...tinted },
    lights: true,
    vertexColors: true,
  });
  return { material, setTint: (tint) => tinted.tint.value.set(tint) };
}
