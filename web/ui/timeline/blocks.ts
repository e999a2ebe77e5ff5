import type { Job } from '../store/state';
import type { Span } from '../store/time-scale';

/** The model's blocks of a dance, frames; the last one may be short. */
export function blocksOf(frames: number, length: number): Span[] {
  if (frames <= 0 || length <= 0) return [];
  return Array.from({ length: Math.ceil(frames / length) }, (_, index) => ({
    from: index * length,
    to: Math.min(frames, (index + 1) * length),
  }));
}

/**
 * The part of a block that is done, from and to 0 to 1: what is shown already where the job tells, else as if blocks
 * were made one after the other.
 */
export function doneOf(block: Span, blocks: readonly Span[], job: Job | null): Span {
  if (!job) return { from: 0, to: 0 };
  const length = block.to - block.from;
  if (job.previewed) {
    const from = Math.max(block.from, job.previewed.from);
    const to = Math.min(block.to, job.previewed.to);
    if (to <= from) return { from: 0, to: 0 };
    return { from: (from - block.from) / length, to: (to - block.from) / length };
  }
  const frames = blocks.at(-1)?.to ?? 0;
  const done = (job.fraction * frames - block.from) / length;
  return { from: 0, to: Math.min(1, Math.max(0, done)) };
}
