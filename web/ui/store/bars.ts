import { accentOf, countedBeats } from './counting';
import { danceDuration } from './selectors';
import type { AppState } from './state';

/** Two moments nearer than this are the same one, seconds. */
const SAME_MOMENT = 0.01;

/** How far a bar is where no beats say it, seconds. */
const WITHOUT_BEATS = 1;

/**
 * The start of the next (1) or of the previous bar (-1), seconds; before the first and after the last one the start and
 * the end of the dance. Without beats it is a second away.
 */
export function barBeside(state: AppState, time: number, direction: 1 | -1): number {
  const beats = countedBeats(state);
  if (beats.times.length === 0) return time + direction * WITHOUT_BEATS;
  const starts = beats.times.filter((_, index) => accentOf(beats, index) !== 'beat');
  return direction > 0
    ? (starts.find((start) => start > time + SAME_MOMENT) ?? danceDuration(state))
    : (starts.findLast((start) => start < time - SAME_MOMENT) ?? 0);
}
