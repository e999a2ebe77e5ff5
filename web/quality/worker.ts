/** Measures one dance off the main thread. */
import { serve } from '../common/serve-tasks';
import type { QualityRequest } from './client';
import { measure, type Report } from './measure';

const tasks = {
  measure: ({ duet, rules }: QualityRequest): Report => measure(duet, rules),
};
export type QualityTasks = typeof tasks;

serve(tasks);
