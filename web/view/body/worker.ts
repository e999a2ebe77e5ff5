import { expose, transfer } from 'comlink';
import type { Build } from './part';
import { buildBody, type BodyMesh } from './mesh';

/** Meshing off the main thread: a third of a second of arithmetic that must not be felt. */
const mesher = {
  build(offsets: Float32Array, build: Build): BodyMesh {
    const mesh = buildBody(offsets, build);
    const { positions, normals, indices, skinJoints, skinWeights, shade } = mesh;
    const arrays = [positions, normals, indices, skinJoints, skinWeights, shade];
    return transfer(
      mesh,
      arrays.map((array) => array.buffer),
    );
  },
};
export type Mesher = typeof mesher;

expose(mesher);
