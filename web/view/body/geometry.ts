import { BufferAttribute, BufferGeometry } from 'three';
import type { Body } from './simplify';

/** A body as three.js draws it: the near triangles first in the index, the light ones behind them. */
export interface BodyGeometry {
  readonly near: BufferGeometry;
  /** The same vertices and index, drawn from the light triangles. */
  readonly light: BufferGeometry;
  /** Draws `near` from the light triangles until it is told otherwise; shadows need no more. */
  lighten(on: boolean): void;
  dispose(): void;
}

/** The full triangles alone, as files take them. */
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
  const most = body.near.length;
  const indices = new Uint32Array(most + body.light.length);
  indices.set(body.near);
  indices.set(body.light, most);
  const index = new BufferAttribute(indices, 1);
  for (const geometry of [near, light]) {
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(index);
  }
  const lighten = (on: boolean): void => {
    if (on) near.setDrawRange(most, body.light.length);
    else near.setDrawRange(0, most);
  };
  lighten(false);
  light.setDrawRange(most, body.light.length);
  return {
    near,
    light,
    lighten,
    dispose() {
      near.dispose();
      light.dispose();
    },
  };
}
