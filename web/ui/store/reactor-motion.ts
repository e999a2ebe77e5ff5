import { RecentCache } from '../../common/recent-cache';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { withFootLock } from '../../motion/contact/foot-lock';
import { sameInputs } from './selectors';
import type { AppState } from './state';

/** More than are drawn at once: the reaction, its preview, the one before, another take, and the coarse layers. */
const MOST_LOCKED = 8;

/** Motions with locked feet by the motions that they were computed from; those of most takes are computed when shown. */
const locked = new RecentCache<SolvedMotion, SolvedMotion>(MOST_LOCKED);

/** A motion as it is drawn: as generated, or with its feet locked; the same object for the same motion. */
function asDrawn(motion: SolvedMotion, footLock: boolean): SolvedMotion {
  if (!footLock) return motion;
  let result = locked.get(motion);
  if (!result) locked.set(motion, (result = withFootLock(motion)));
  return result;
}

/**
 * The generated dancer's motion that is downloaded, and drawn unless there is a preview of a newer one: as generated,
 * or with its feet locked. The same object as long as reaction and foot lock are the same.
 */
export function reactorMotion({
  reaction,
  footLock,
}: Pick<AppState, 'reaction' | 'footLock'>): SolvedMotion | null {
  return reaction && asDrawn(reaction.motion, footLock);
}

/** The motion of the coarse layer alone as it is drawn; null while its overlay is off or it is not decoded. */
export function coarseMotion({
  coarse,
  overlays,
  footLock,
}: Pick<AppState, 'coarse' | 'overlays' | 'footLock'>): SolvedMotion | null {
  return overlays.ghost && coarse.motion ? asDrawn(coarse.motion, footLock) : null;
}

/** The same of the take that is compared with the one on the stage. */
export function otherCoarseMotion({
  coarse,
  overlays,
  footLock,
}: Pick<AppState, 'coarse' | 'overlays' | 'footLock'>): SolvedMotion | null {
  return overlays.ghost && coarse.other ? asDrawn(coarse.other, footLock) : null;
}

/**
 * The dance before a change as it is drawn beside the new one; null while takes are compared, and where the new one is
 * the same again.
 */
export function earlierMotion({
  earlier,
  reaction,
  preview,
  compare,
  footLock,
}: Pick<AppState, 'earlier' | 'reaction' | 'preview' | 'compare' | 'footLock'>): SolvedMotion | null {
  if (!earlier || !reaction || compare !== 'off') return null;
  if (!preview && sameInputs(earlier.inputs, reaction.inputs)) return null;
  return asDrawn(earlier.motion, footLock);
}

/** Caches a motion whose feet a worker has locked. */
export function cacheLocked(motion: SolvedMotion, result: SolvedMotion): void {
  locked.set(motion, result);
}
