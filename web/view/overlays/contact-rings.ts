import {
  Color,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  PlaneGeometry,
  ShaderMaterial,
} from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { LEGS } from '../../motion/skeleton/limbs';
import { ballHeight, footMatrix } from '../dancer/foot-placement';
import { MAX_FIGURES, type Overlay } from './overlay';
import { contactOpacity, footContactsOf, type FootContacts } from './contact-fade';

/** Outer size of a ring with its glow, metres. */
const WIDTH = 0.28;
const LENGTH = 0.44;
/** Middle of a ring, as a share of the way from the ankle to the toe joint. */
const MIDDLE = 0.7;
/** Greatest height of a ring above the floor, metres. */
const MAX_HEIGHT = 0.08;

const VERTEX = /* glsl */ `
attribute vec4 rgba;
varying vec2 vAt;
varying vec4 vRgba;
void main() {
  vAt = uv * 2.0 - 1.0;
  vRgba = rgba;
  gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = /* glsl */ `
varying vec2 vAt;
varying vec4 vRgba;
void main() {
  float radius = length(vAt);
  float line = 1.0 - smoothstep(0.035, 0.035 + 1.5 * fwidth(radius), abs(radius - 0.8));
  float glow = 0.35 * (1.0 - smoothstep(0.0, 0.19, abs(radius - 0.8)));
  gl_FragColor = vec4(vRgba.rgb, vRgba.a * max(line, glow) * (1.0 - smoothstep(0.96, 1.0, radius)));
  #include <colorspace_fragment>
}`;

/** Rings on the floor under feet in contact with it. */
export function createContactRings(): Overlay {
  const capacity = MAX_FIGURES * LEGS.length;
  const plane = new PlaneGeometry(WIDTH, LENGTH).rotateX(-Math.PI / 2);
  const rgba = new InstancedBufferAttribute(new Float32Array(capacity * 4), 4).setUsage(DynamicDrawUsage);
  plane.setAttribute('rgba', rgba);
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    transparent: true,
    depthWrite: false,
  });
  const object = new InstancedMesh(plane, material, capacity);
  object.instanceMatrix.setUsage(DynamicDrawUsage);
  object.frustumCulled = false;
  object.renderOrder = 2;
  const colours = { leader: new Color(), reactor: new Color() };
  const contactsByMotion = new WeakMap<SolvedMotion, FootContacts>();
  const place = new Matrix4();

  return {
    object,
    update(figures, seconds) {
      let count = 0;
      for (const { role, motion, joints } of figures) {
        const contacts = contactsByMotion.get(motion) ?? footContactsOf(motion);
        contactsByMotion.set(motion, contacts);
        LEGS.forEach((leg, side) => {
          const opacity = contactOpacity(contacts[side]!, motion.fps, seconds);
          if (opacity <= 0) return;
          // A foot in contact may be a little above the floor; its ring stays with it.
          const height = Math.min(MAX_HEIGHT, Math.max(0, ballHeight(joints, leg)));
          object.setMatrixAt(count, footMatrix(joints, leg, MIDDLE, 0.006 + height, place));
          const { r, g, b } = colours[role];
          rgba.setXYZW(count++, r, g, b, opacity);
        });
      }
      object.count = count;
      object.visible = count > 0;
      object.instanceMatrix.needsUpdate = true;
      rgba.needsUpdate = true;
    },
    setLook(look) {
      colours.leader.set(look.leader);
      colours.reactor.set(look.reactor);
    },
    dispose() {
      plane.dispose();
      material.dispose();
      object.dispose();
    },
  };
}
