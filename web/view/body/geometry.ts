import { BufferAttribute, BufferGeometry } from 'three';
import type { Body } from './simplify';

/** A body as three.js draws it in two levels of detail, `near` and `light`, on the same vertices. */
export interface BodyGeometry {
  readonly near: BufferGeometry;
  /** Draws the low level of detail. */
  readonly light: BufferGeometry;
  /** Draws `near` in the low level of detail too, or not any more. */
  setLowDetail(on: boolean): void;
  dispose(): void;
}

/** All triangles of a body, for files. */
export function toFullGeometry(body: Body): BufferGeometry {
  const { near } = toGeometry(body);
  near.setIndex(new BufferAttribute(body.indices, 1));
  near.setDrawRange(0, body.indices.length);
  return near;
}

export function toGeometry(body: Body): BodyGeometry {
  const [near, light] = [new BufferGeometry(), new BufferGeometry()];
  const shade = new Float32Array(body.shade.length * 3);
  body.shade.forEach((value, v) => shade.fill(value, v * 3, v * 3 + 3));
  const attributes = {
    position: new BufferAttribute(body.positions, 3),
    normal: new BufferAttribute(body.normals, 3),
    skinIndex: new BufferAttribute(body.skinJoints, 4),
    skinWeight: new BufferAttribute(body.skinWeights, 4),
    color: new BufferAttribute(shade, 3),
  };
  const nearCount = body.near.length;
  const indices = new Uint32Array(nearCount + body.light.length);
  indices.set(body.near);
  indices.set(body.light, nearCount);
  const index = new BufferAttribute(indices, 1);
  for (const geometry of [near, light]) {
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(index);
  }
  const setLowDetail = (on: boolean): void => {
    if (on) near.setDrawRange(nearCount, body.light.length);
    else near.setDrawRange(0, nearCount);
  };
  setLowDetail(false);
  light.setDrawRange(nearCount, body.light.length);
  return {
    near,
    light,
    setLowDetail,
    dispose() {
      near.dispose();
      light.dispose();
    },
  };
}
