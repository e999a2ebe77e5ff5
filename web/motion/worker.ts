/** Reads and solves one motion file, or only its joints, off the main thread, so that a long one does not freeze the page. */
import { serve } from '../common/serve-tasks';
import type { LeaderRequest, ReadLeader } from './client';
import { solve } from './fit/ik';
import { type Inspection, inspectMotion } from './import/inspect';
import { readLeaderFile } from './import/read';

const tasks = {
  async read({ files, options, remembered }: LeaderRequest): Promise<ReadLeader> {
    const file = await readLeaderFile(files, options, remembered);
    return { file, motion: solve(file.clip) };
  },
  inspect: ({ files, options, remembered }: LeaderRequest): Promise<Inspection> =>
    inspectMotion(files, options, remembered),
};
export type MotionTasks = typeof tasks;

serve(tasks);
