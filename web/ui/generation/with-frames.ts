import type { SolvedMotion } from '../../motion/skeleton/clip';

/** A motion with some frames replaced by those of a part of the same body, from the frame `from` on. */
export function withFrames(whole: SolvedMotion, part: SolvedMotion, from: number): SolvedMotion {
  const replaced = (values: Float32Array, newer: Float32Array): Float32Array => {
    const copy = values.slice();
    copy.set(newer, (values.length / whole.frames) * from);
    return copy;
  };
  return {
    ...whole,
    root: replaced(whole.root, part.root),
    rotations: replaced(whole.rotations, part.rotations),
    positions: replaced(whole.positions, part.positions),
  };
}

/** Whether two motions have the same skeleton. */
export function sameBody(a: SolvedMotion, b: SolvedMotion): boolean {
  return a.offsets.every((value, i) => value === b.offsets[i]);
}
