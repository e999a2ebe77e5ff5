import {
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  PlaneGeometry,
  ShaderMaterial,
} from 'three';
import { ramp } from './body/field';
import { FEET, standAt } from './dancer/foot-placement';
import type { Look } from './theme';

/** Dark spots under feet that are close to the floor: what makes them stand instead of hover. */
export interface Contacts {
  readonly object: InstancedMesh;
  /** @param dancers joint positions (22 x 3, metres) of whoever is on the stage, at most two. */
  update(dancers: readonly Float32Array[]): void;
  setLook(look: Look): void;
  dispose(): void;
}

const MOST_FEET = 4;
/** Size of a spot, metres. */
const LONG = 0.4;
const WIDE = 0.24;
/** A foot this high has no spot left, metres above where it stands. */
const LIFTED = 0.16;

const VERTEX = /* glsl */ `
attribute float strength;
varying vec2 vAt;
varying float vStrength;
void main() {
  vAt = uv * 2.0 - 1.0;
  vStrength = strength;
  gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = /* glsl */ `
uniform float opacity;
varying vec2 vAt;
varying float vStrength;
void main() {
  float fade = max(0.0, 1.0 - dot(vAt, vAt));
  gl_FragColor = vec4(0.0, 0.0, 0.0, fade * fade * vStrength * opacity);
}`;

export function createContacts(): Contacts {
  const plane = new PlaneGeometry(WIDE, LONG).rotateX(-Math.PI / 2);
  const strength = new InstancedBufferAttribute(new Float32Array(MOST_FEET), 1).setUsage(DynamicDrawUsage);
  plane.setAttribute('strength', strength);
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { opacity: { value: 0 } },
    transparent: true,
    depthWrite: false,
  });
  const object = new InstancedMesh(plane, material, MOST_FEET);
  object.instanceMatrix.setUsage(DynamicDrawUsage);
  object.frustumCulled = false;
  object.count = 0;
  object.renderOrder = 1;
  const place = new Matrix4();
  return {
    object,
    update(dancers) {
      let count = 0;
      for (const joints of dancers)
        for (const foot of FEET) {
          object.setMatrixAt(count, standAt(joints, foot, 0.003, place));
          const height = (joint: number): number => joints[joint * 3 + 1]!;
          strength.setX(count, 1 - ramp(0, LIFTED, Math.min(height(foot.toe), height(foot.ankle) - 0.05)));
          count++;
        }
      object.count = count;
      object.instanceMatrix.needsUpdate = true;
      strength.needsUpdate = true;
    },
    setLook(look) {
      material.uniforms['opacity']!.value = look.contact;
    },
    dispose() {
      plane.dispose();
      material.dispose();
      object.dispose();
    },
  };
}
