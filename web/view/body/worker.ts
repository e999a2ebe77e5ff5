import { expose, transfer } from 'comlink';
import { makeBody, type Body } from './simplify';
import type { Build } from './part';

/** Meshing off the main thread: a third of a second of arithmetic that must not be felt. */
const mesher = {
  async build(offsets: Float32Array, build: Build): Promise<Body> {
    const body = await makeBody(offsets, build);
    const { positions, normals, indices, light, skinJoints, skinWeights, shade } = body;
    const arrays = [positions, normals, indices, light, skinJoints, skinWeights, shade];
    return transfer(
      body,
      arrays.map((array) => array.buffer),
    );
  },
};
export type Mesher = typeof mesher;

expose(mesher);
