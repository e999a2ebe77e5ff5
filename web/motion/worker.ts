/** Reads and solves one motion file off the main thread, so that a long one does not freeze the page. */
import { serve } from '../common/run-in-worker';
import { readBvh } from './bvh/read';
import type { LeaderRequest, ReadLeader } from './client';
import { solve } from './fit/ik';

const tasks = {
  read({ text, fps }: LeaderRequest): ReadLeader {
    const file = readBvh(text, fps === null ? {} : { fps });
    return { file, motion: solve(file.clip) };
  },
};
export type MotionTasks = typeof tasks;

serve(tasks);
