import {
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  PlaneGeometry,
  ShaderMaterial,
} from 'three';
import { smoothstep } from './body/field';
import { FEET, footMatrix } from './dancer/foot-placement';
import type { Look } from './theme';

/** Dark spots under feet that are close to the floor, which make them look as if they stood on it. */
interface ContactShadows {
  readonly object: InstancedMesh;
  /** @param dancers joint positions (22 x 3, metres), at most two dancers. */
  update(dancers: readonly Float32Array[]): void;
  setLook(look: Look): void;
  dispose(): void;
}

const MAX_FEET = 4;
/** Size of a shadow, metres. */
const LENGTH = 0.4;
const WIDTH = 0.24;
/** Height of a foot from which on it has no shadow, metres. */
const MAX_HEIGHT = 0.16;

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

export function createContactShadows(): ContactShadows {
  const plane = new PlaneGeometry(WIDTH, LENGTH).rotateX(-Math.PI / 2);
  const strength = new InstancedBufferAttribute(new Float32Array(MAX_FEET), 1).setUsage(DynamicDrawUsage);
  plane.setAttribute('strength', strength);
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { opacity: { value: 0 } },
    transparent: true,
    depthWrite: false,
  });
  const object = new InstancedMesh(plane, material, MAX_FEET);
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
          object.setMatrixAt(count, footMatrix(joints, foot, 0.003, place));
          const height = (joint: number): number => joints[joint * 3 + 1]!;
          strength.setX(
            count,
            1 - smoothstep(0, MAX_HEIGHT, Math.min(height(foot.toe), height(foot.ankle) - 0.05)),
          );
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
