import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { MeshoptSimplifier } from 'meshoptimizer/simplifier';
import { J } from '../../motion/skeleton/skeleton';
import { buildBody, type BodyMesh } from './mesh';
import type { Build } from './part';

/** A body with two lower levels of detail: lists of fewer triangles (x 3) on the same vertices. */
export interface Body extends BodyMesh {
  /** The skeleton that it was meshed for, as rest offsets (22 x 3, metres); rigs are bound to these. */
  readonly offsets: Float32Array;
  /** For the stage, about half as many as `indices`. */
  readonly near: Uint32Array;
  /** For shadows, ghosts and bodies that are small in the picture, about a quarter as many as `indices`. */
  readonly light: Uint32Array;
}

const NEAR_SHARE = 0.5;
const LIGHT_SHARE = 0.25;
/** Greatest error of a simplified surface, as a share of the body's size. */
const MAX_ERROR = 0.005;
/** Weights of errors of the normals and of the shade beside errors of the positions. */
const ATTRIBUTE_WEIGHTS = [0.2, 0.2, 0.2, 0.2];
const DETAILED_JOINTS: ReadonlySet<number> = new Set([J.head, J.left_wrist, J.right_wrist]);

/** Meshes a body for a skeleton (22 x 3 offsets, metres), with its lower levels of detail. */
export async function makeBody(offsets: ArrayLike<number>, build: Build): Promise<Body> {
  await Promise.all([MeshoptSimplifier.ready, MeshoptEncoder.ready]);
  const mesh = buildBody(offsets, build);
  return {
    ...mesh,
    offsets: Float32Array.from(offsets),
    near: simplified(mesh, NEAR_SHARE, detailed(mesh)),
    light: simplified(mesh, LIGHT_SHARE, null),
  };
}

/** Per vertex, whether it stays where it is: on heads and hands, which are looked at most. */
function detailed({ skinJoints, shade }: BodyMesh): Uint8Array {
  return Uint8Array.from(shade, (_, v) => Number(DETAILED_JOINTS.has(skinJoints[v * 4]!)));
}

/** @param kept per vertex, whether it must stay; null lets all go */
function simplified(mesh: BodyMesh, share: number, kept: Uint8Array | null): Uint32Array {
  const attributes = new Float32Array(mesh.shade.length * ATTRIBUTE_WEIGHTS.length);
  mesh.shade.forEach((shade, v) => {
    attributes.set(mesh.normals.subarray(v * 3, v * 3 + 3), v * 4);
    attributes[v * 4 + 3] = shade;
  });
  const [triangles] = MeshoptSimplifier.simplifyWithAttributes(
    mesh.indices,
    mesh.positions,
    3,
    attributes,
    ATTRIBUTE_WEIGHTS.length,
    ATTRIBUTE_WEIGHTS,
    kept,
    3 * Math.round((share * mesh.indices.length) / 3),
    MAX_ERROR,
    // Long thin triangles would streak the shading.
    ['Regularize'],
  );
  return cacheOrdered(triangles);
}

/** The same triangles in an order for the vertex cache, which halves the work without a graphics card. */
function cacheOrdered(triangles: Uint32Array): Uint32Array {
  const ordered = triangles.slice();
  const [numbers] = MeshoptEncoder.reorderMesh(ordered, true, false);
  // The encoder renumbers the vertices as well; here they keep their numbers.
  const old = new Uint32Array(numbers.length);
  numbers.forEach((number, vertex) => (old[number] = vertex));
  return ordered.map((vertex) => old[vertex]!);
}
