/** Measures one dance off the main thread. */
import { serve } from '../common/run-in-worker';
import type { QualityQuestion } from './client';
import { measure, type Report } from './measure';

const tasks = {
  measure: ({ duet, rules }: QualityQuestion): Report => measure(duet, rules),
};
export type QualityTasks = typeof tasks;

serve(tasks);
