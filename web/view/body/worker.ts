import { serve } from '../../common/serve-tasks';
import { makeBody, type Body } from './simplify';
import type { Build } from './part';

/** Meshing off the main thread, which it would block for a third of a second. */
const tasks = {
  build: ({ offsets, build }: { offsets: Float32Array; build: Build }): Promise<Body> =>
    makeBody(offsets, build),
};
export type BodyTasks = typeof tasks;

serve(tasks);
