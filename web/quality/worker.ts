/** Measures one dance off the main thread. */
import type { QualityAnswer, QualityQuestion } from './client';
import { measure } from './measure';

globalThis.onmessage = ({ data: { duet, rules } }: MessageEvent<QualityQuestion>) => {
  globalThis.postMessage(measure(duet, rules) satisfies QualityAnswer);
};
