import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { MeshoptSimplifier } from 'meshoptimizer/simplifier';
import { buildBody, type BodyMesh } from './mesh';
import type { Build } from './part';

/** A body with two lighter lists of triangles (x 3) on the same vertices. What it costs to draw is its triangles. */
export interface Body extends BodyMesh {
  /** The skeleton that it was meshed for, as rest offsets (22 x 3, metres); rigs are bound to these. */
  readonly offsets: Float32Array;
  /** As it is seen on the stage, about half as many as `indices`. */
  readonly near: Uint32Array;
  /** For shadows, from afar, and for glass, about a quarter as many as `indices`. */
  readonly light: Uint32Array;
}

const NEAR_SHARE = 0.5;
const LIGHT_SHARE = 0.25;
/** A lighter surface stays this close to the full one, as a share of the body's size. */
const MOST_ERROR = 0.005;
/** How much a normal that turns away counts beside a surface that moves. */
const NORMALS = [0.2, 0.2, 0.2];

/** Meshes a body for a skeleton, with its lighter triangles. */
export async function makeBody(offsets: ArrayLike<number>, build: Build): Promise<Body> {
  await Promise.all([MeshoptSimplifier.ready, MeshoptEncoder.ready]);
  const mesh = buildBody(offsets, build);
  return {
    ...mesh,
    offsets: Float32Array.from(offsets),
    near: lighter(mesh, NEAR_SHARE),
    light: lighter(mesh, LIGHT_SHARE),
  };
}

function lighter(mesh: BodyMesh, share: number): Uint32Array {
  const [triangles] = MeshoptSimplifier.simplifyWithAttributes(
    mesh.indices,
    mesh.positions,
    3,
    mesh.normals,
    3,
    NORMALS,
    null,
    3 * Math.round((share * mesh.indices.length) / 3),
    MOST_ERROR,
    // Long thin triangles would streak the shading.
    ['Regularize'],
  );
  return neighboursFirst(triangles);
}

/** The same triangles in an order in which a vertex is seldom computed twice, which halves the work without a GPU. */
function neighboursFirst(triangles: Uint32Array): Uint32Array {
  const ordered = triangles.slice();
  const [numbers] = MeshoptEncoder.reorderMesh(ordered, true, false);
  // It numbers the vertices anew as well; here they keep their numbers.
  const old = new Uint32Array(numbers.length);
  numbers.forEach((number, vertex) => (old[number] = vertex));
  return ordered.map((vertex) => old[vertex]!);
}
