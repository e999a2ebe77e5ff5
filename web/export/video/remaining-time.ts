/** Work this short says nothing about the rest yet, seconds. */
const SOON = 0.8;

/** Whole seconds that the rest will take if it goes on as so far; null while that is a guess. */
export function secondsLeft(elapsed: number, done: number, total: number): number | null {
  if (elapsed < SOON || done < 1) return null;
  return Math.ceil((elapsed / done) * (total - done));
}
