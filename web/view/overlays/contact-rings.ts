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
import { FEET, standAt } from '../dancer/foot-placement';
import { MOST_FIGURES, type Show } from './overlay';
import { contactAt, stepsOf, type Steps } from './contact-fade';

/** Outer size of a ring with its glow, metres. */
const WIDE = 0.28;
const LONG = 0.44;
/** Highest place of a ring above the floor, metres. */
const HOVER = 0.08;

const VERTEX = /* glsl */ `
attribute vec4 paint;
varying vec2 vAt;
varying vec4 vPaint;
void main() {
  vAt = uv * 2.0 - 1.0;
  vPaint = paint;
  gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = /* glsl */ `
varying vec2 vAt;
varying vec4 vPaint;
void main() {
  float away = length(vAt);
  float line = 1.0 - smoothstep(0.035, 0.035 + 1.5 * fwidth(away), abs(away - 0.8));
  float glow = 0.35 * (1.0 - smoothstep(0.0, 0.19, abs(away - 0.8)));
  gl_FragColor = vec4(vPaint.rgb, vPaint.a * max(line, glow) * (1.0 - smoothstep(0.96, 1.0, away)));
  #include <colorspace_fragment>
}`;

/** Rings on the floor under feet that stand. */
export function createContactRings(): Show {
  const most = MOST_FIGURES * FEET.length;
  const plane = new PlaneGeometry(WIDE, LONG).rotateX(-Math.PI / 2);
  const paint = new InstancedBufferAttribute(new Float32Array(most * 4), 4).setUsage(DynamicDrawUsage);
  plane.setAttribute('paint', paint);
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    transparent: true,
    depthWrite: false,
  });
  const object = new InstancedMesh(plane, material, most);
  object.instanceMatrix.setUsage(DynamicDrawUsage);
  object.frustumCulled = false;
  object.renderOrder = 2;
  const colours = { leader: new Color(), reactor: new Color() };
  const known = new WeakMap<SolvedMotion, Steps>();
  const place = new Matrix4();

  return {
    object,
    update(figures, seconds) {
      let count = 0;
      for (const { role, motion, joints } of figures) {
        const steps = known.get(motion) ?? stepsOf(motion);
        known.set(motion, steps);
        FEET.forEach((foot, side) => {
          const strength = contactAt(steps[side]!, motion.fps, seconds);
          if (strength <= 0) return;
          // A standing foot may hover a little; its ring stays with it.
          const height = Math.min(HOVER, Math.max(0, joints[foot.toe * 3 + 1]!));
          object.setMatrixAt(count, standAt(joints, foot, 0.006 + height, place));
          const { r, g, b } = colours[role];
          paint.setXYZW(count++, r, g, b, strength);
        });
      }
      object.count = count;
      object.visible = count > 0;
      object.instanceMatrix.needsUpdate = true;
      paint.needsUpdate = true;
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
