import { wrap, type Remote } from 'comlink';
import type { Build } from './part';
import type { Body } from './lighter';
import type { Mesher } from './worker';

/** Bodies already meshed, by skeleton and build; meshes the others in a worker. */
export interface BodyLibrary {
  /** The mesh for a skeleton, made for `roundedOffsets`. */
  request(offsets: ArrayLike<number>, build: Build): Promise<Body>;
  dispose(): void;
}

/**
 * Bone lengths are rounded before meshing, metres: every generation solves a slightly different skeleton, and the
 * skin follows the exact bones anyway.
 */
const ROUNDING = 0.008;
const KEPT = 8;

export const roundedOffsets = (offsets: ArrayLike<number>): Float32Array =>
  Float32Array.from(offsets, (value) => Math.round(value / ROUNDING) * ROUNDING);

export function createBodyLibrary(): BodyLibrary {
  let worker: Worker | null = null;
  let mesher: Remote<Mesher> | null = null;
  const bodies = new Map<string, Promise<Body>>();

  async function mesh(offsets: Float32Array, build: Build): Promise<Body> {
    try {
      return await inWorker(offsets, build);
    } catch (error) {
      // Slower and felt, but a stage without its worker still shows the dance.
      console.warn('Bodies are made on the main thread, their worker failed:', error);
      const { makeBody } = await import('./lighter');
      return makeBody(offsets, build);
    }
  }

  function inWorker(offsets: Float32Array, build: Build): Promise<Body> {
    worker ??= new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'bodies' });
    mesher ??= wrap<Mesher>(worker);
    const started = worker;
    const broken = new Promise<never>((_, reject) => {
      started.addEventListener('error', (event) => reject(new Error(event.message)), { once: true });
    });
    return Promise.race([mesher.build(offsets, build), broken]);
  }

  return {
    request(offsets, build) {
      const rounded = roundedOffsets(offsets);
      const key = `${build.width} ${build.waist} ${rounded.join(' ')}`;
      let body = bodies.get(key);
      if (body === undefined) {
        body = mesh(rounded, build);
        bodies.set(key, body);
        for (const old of bodies.keys()) {
          if (bodies.size <= KEPT) break;
          bodies.delete(old);
        }
      }
      return body;
    },
    dispose() {
      worker?.terminate();
      worker = null;
      mesher = null;
      bodies.clear();
    },
  };
}
