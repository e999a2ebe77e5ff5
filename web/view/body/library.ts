import { WorkerConnection } from '../../common/run-in-worker';
import type { Build } from './part';
import type { Body } from './simplify';
import type { BodyTasks } from './worker';

/** A cache of bodies by skeleton and build; bodies that are not cached are meshed in a worker. */
export interface BodyLibrary {
  /** The body for a skeleton (22 x 3 offsets, metres), or one for nearly the same: its `offsets` say for which. */
  request(offsets: ArrayLike<number>, build: Build): Promise<Body>;
  dispose(): void;
}

/**
 * A body fits skeletons whose offsets are this near on every axis, metres: every generation solves a slightly different
 * one, and the skin follows the exact bones anyway.
 */
const MAX_OFFSET_DIFFERENCE = 0.01;
const MAX_CACHED_BODIES = 8;

/** Meshing takes a third of a second; a worker that says nothing for this long is not waited for, seconds. */
const BODY_TIMEOUTS = { first: 20, next: 10 };

interface CachedBody {
  readonly offsets: Float32Array;
  readonly build: Build;
  readonly body: Promise<Body>;
}

export function createBodyLibrary(): BodyLibrary {
  let connection: WorkerConnection<BodyTasks> | null = null;
  let bodies: CachedBody[] = [];

  async function mesh(offsets: Float32Array, build: Build): Promise<Body> {
    try {
      return await inWorker(offsets, build);
    } catch (error) {
      // This blocks the page for a moment, but the stage works without its worker.
      console.warn('Bodies are made on the main thread, their worker failed:', error);
      const { makeBody } = await import('./simplify');
      return makeBody(offsets, build);
    }
  }

  function inWorker(offsets: Float32Array, build: Build): Promise<Body> {
    if (!connection || connection.ended)
      connection = new WorkerConnection(
        new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'bodies' }),
        { timeouts: BODY_TIMEOUTS },
      );
    return connection.call('build', { offsets, build });
  }

  return {
    request(offsets, build) {
      const found = bodies.find(
        (cached) =>
          cached.build === build &&
          cached.offsets.every((value, i) => Math.abs(value - offsets[i]!) < MAX_OFFSET_DIFFERENCE),
      );
      if (found) return found.body;
      const own = Float32Array.from(offsets);
      const body = mesh(own, build);
      bodies = [...bodies, { offsets: own, build, body }].slice(-MAX_CACHED_BODIES);
      // The next one who asks tries again.
      body.catch(() => {
        bodies = bodies.filter((cached) => cached.body !== body);
      });
      return body;
    },
    dispose() {
      connection?.dispose();
      connection = null;
      bodies = [];
    },
  };
}
