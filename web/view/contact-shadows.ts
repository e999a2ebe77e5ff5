import { smoothstep } from '../motion/math/vec3';
import { LEGS } from '../motion/skeleton/limbs';
import {
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  PlaneGeometry,
  ShaderMaterial,
  Vector3,
} from 'three';
import { ballHeight, footMatrix, heelHeight } from './dancer/foot-placement';
import { MAX_FIGURES, type Figure } from './overlays/overlay';
import type { Look } from './theme';

/** Dark spots under balls and heels that are close to the floor, which make feet look as if they stood on it. */
interface ContactShadows {
  readonly object: InstancedMesh;
  update(figures: readonly Figure[]): void;
  setLook(look: Look): void;
  dispose(): void;
}

/** Size of the shadow of a part of a foot that touches the floor, metres. */
const LENGTH = 0.25;
const WIDTH = 0.2;
/** Places of the shadows, as shares of the way from the ankle to the toe joint. */
const BALL = 1.05;
const HEEL = -0.05;
/** Height of a sole from which on it has no shadow, metres, and how much larger its shadow is there. */
const MAX_HEIGHT = 0.1;
const GROWTH = 0.6;

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
  const capacity = MAX_FIGURES * LEGS.length * 2;
  const plane = new PlaneGeometry(WIDTH, LENGTH).rotateX(-Math.PI / 2);
  const strength = new InstancedBufferAttribute(new Float32Array(capacity), 1).setUsage(DynamicDrawUsage);
  plane.setAttribute('strength', strength);
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { opacity: { value: 0 } },
    transparent: true,
    depthWrite: false,
  });
  const object = new InstancedMesh(plane, material, capacity);
  object.instanceMatrix.setUsage(DynamicDrawUsage);
  object.frustumCulled = false;
  object.count = 0;
  object.renderOrder = 1;
  const place = new Matrix4();
  const size = new Vector3();
  return {
    object,
    update(figures) {
      let count = 0;
      const add = (height: number): void => {
        const lifted = smoothstep(0, MAX_HEIGHT, height);
        place.scale(size.setScalar(1 + GROWTH * lifted));
        object.setMatrixAt(count, place);
        strength.setX(count++, (1 - lifted) ** 2);
      };
      for (const { joints, motion } of figures)
        for (const leg of LEGS) {
          footMatrix(joints, leg, BALL, 0.003, place);
          add(ballHeight(joints, leg));
          footMatrix(joints, leg, HEEL, 0.003, place);
          add(heelHeight(joints, motion.offsets, leg));
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
