/** Reads and solves one motion file off the main thread, so that a long one does not freeze the page. */
import { serve } from '../common/run-in-worker';
import type { LeaderRequest, ReadLeader } from './client';
import { solve } from './fit/ik';
import { readLeaderFile } from './import/read';

const tasks = {
  async read({ files, options, remembered }: LeaderRequest): Promise<ReadLeader> {
    const file = await readLeaderFile(files, options, remembered);
    return { file, motion: solve(file.clip) };
  },
};
export type MotionTasks = typeof tasks;

serve(tasks);
