import { MeshoptSimplifier } from 'meshoptimizer/simplifier';
import { buildBody, type BodyMesh } from './mesh';
import type { Build } from './part';

/** A body with a second, lighter list of triangles on the same vertices: for shadows, from afar, and for glass. */
export interface Body extends BodyMesh {
  /** triangles x 3, about 40 % as many as `indices`. */
  readonly light: Uint32Array;
}

const SHARE = 0.4;
/** A light surface stays this close to the full one, as a share of the body's size. */
const MOST_ERROR = 0.004;
/** How much a normal that turns away counts beside a surface that moves. */
const NORMALS = [0.2, 0.2, 0.2];

/** Meshes a body for a skeleton, with its light triangles. */
export async function makeBody(offsets: ArrayLike<number>, build: Build): Promise<Body> {
  await MeshoptSimplifier.ready;
  const mesh = buildBody(offsets, build);
  const target = 3 * Math.round((SHARE * mesh.indices.length) / 3);
  const [light] = MeshoptSimplifier.simplifyWithAttributes(
    mesh.indices,
    mesh.positions,
    3,
    mesh.normals,
    3,
    NORMALS,
    null,
    target,
    MOST_ERROR,
    // Long thin triangles would streak the shading.
    ['Regularize'],
  );
  return { ...mesh, light };
}
