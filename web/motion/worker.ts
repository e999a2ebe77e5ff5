/** Reads and solves one motion file off the main thread, so that a long one does not freeze the page. */
import { readBvh } from './bvh/read';
import { AppError } from '../common/error';
import { solve } from './fit/ik';
import type { LeaderAnswer, LeaderQuestion } from './client';

globalThis.onmessage = ({ data }: MessageEvent<LeaderQuestion>) => {
  globalThis.postMessage(answer(data));
};

function answer({ text, fps }: LeaderQuestion): LeaderAnswer {
  try {
    const file = readBvh(text, fps === null ? {} : { fps });
    return { ok: true, file, motion: solve(file.clip) };
  } catch (error) {
    // Errors cross as data: a structured clone would lose code and hint.
    if (error instanceof AppError) {
      const { code, message, hint } = error;
      return { ok: false, failure: { code, message, hint } };
    }
    return { ok: false, failure: null };
  }
}
