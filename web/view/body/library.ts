import { wrap, type Remote } from 'comlink';
import type { Build } from './part';
import type { Body } from './simplify';
import type { Mesher } from './worker';

/** A cache of bodies by skeleton and build; meshes the others in a worker. */
export interface BodyLibrary {
  /** The body for a skeleton (22 x 3 offsets, metres), or one for nearly the same: its `offsets` say for which. */
  request(offsets: ArrayLike<number>, build: Build): Promise<Body>;
  dispose(): void;
}

/**
 * A body fits skeletons whose offsets are this near on every axis, metres: every generation solves a slightly different
 * one, and the skin follows the exact bones anyway.
 */
const NEAR = 0.01;
const KEPT = 8;

interface Kept {
  readonly offsets: Float32Array;
  readonly build: Build;
  readonly body: Promise<Body>;
}

export function createBodyLibrary(): BodyLibrary {
  let worker: Worker | null = null;
  let mesher: Remote<Mesher> | null = null;
  let bodies: Kept[] = [];

  async function mesh(offsets: Float32Array, build: Build): Promise<Body> {
    try {
      return await inWorker(offsets, build);
    } catch (error) {
      // Slower and felt, but a stage without its worker still shows the dance.
      console.warn('Bodies are made on the main thread, their worker failed:', error);
      const { makeBody } = await import('./simplify');
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
      const found = bodies.find(
        (kept) =>
          kept.build === build && kept.offsets.every((value, i) => Math.abs(value - offsets[i]!) < NEAR),
      );
      if (found) return found.body;
      const own = Float32Array.from(offsets);
      const body = mesh(own, build);
      bodies = [...bodies, { offsets: own, build, body }].slice(-KEPT);
      return body;
    },
    dispose() {
      worker?.terminate();
      worker = null;
      mesher = null;
      bodies = [];
    },
  };
}
