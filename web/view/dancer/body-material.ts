import {
  Color,
  type Material,
  MeshStandardMaterial,
  ShaderMaterial,
  UniformsLib,
  UniformsUtils,
} from 'three';

/** The material of a solid body: matt, lit by the stage's lights, in one colour. */
export interface BodyMaterial {
  readonly material: Material;
  setTint(tint: number): void;
}

const ROUGHNESS = 0.62;

/** Lighting per pixel, which a graphics card does without effort. */
export function perPixelMaterial(): BodyMaterial {
  const material = new MeshStandardMaterial({ roughness: ROUGHNESS, metalness: 0, vertexColors: true });
  return { material, setTint: (tint) => material.color.set(tint) };
}

// The same shading as `perPixelMaterial`'s (three.js: GGX specular over Lambert diffuse, reflectance 0.04), but without
// the compensation for multiple scattering.
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
  float nDotH = dot(normal, halfway);
  float lobe = nDotH * nDotH * (ALPHA2 - 1.0) + 1.0;
  float grazing = 1.0 - saturate(dot(view, halfway));
  float fresnel = 0.04 + 0.96 * grazing * grazing * grazing * grazing * grazing;
  // Smith's masking and shadowing in the approximation of Hammon (2017), without square roots.
  float visibility = mix(2.0 * towards * facing, towards + facing, ALPHA);
  float highlight = fresnel * ALPHA2 * RECIPROCAL_PI * 0.5 / max(lobe * lobe * visibility, EPSILON);
  return light.color * towards * (albedo * (1.0 - fresnel) * RECIPROCAL_PI + highlight);
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
 * Lighting per vertex, shadows per pixel: with a software renderer this takes half the time, and its pictures are too
 * small for a visible difference. Only the first directional light may cast shadows.
 */
export function perVertexMaterial(): BodyMaterial {
  const uniforms = { tint: { value: new Color() } };
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...UniformsUtils.clone(UniformsLib.lights), ...uniforms },
    lights: true,
    vertexColors: true,
  });
  return { material, setTint: (tint) => uniforms.tint.value.set(tint) };
}
