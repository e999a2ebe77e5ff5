import type { SolvedMotion } from '../../motion/skeleton/clip';
import { lockFeet } from '../../motion/contact/foot-lock';
import type { AppState } from './state';

/** Locked motions by the free ones that they were made from; they go when those go. */
const locked = new WeakMap<SolvedMotion, SolvedMotion>();

/** A motion as it is drawn: as the model made it, or with its feet locked; the same object for the same motion. */
export function asDrawn(free: SolvedMotion, footLock: boolean): SolvedMotion {
  if (!footLock) return free;
  let motion = locked.get(free);
  if (!motion) locked.set(free, (motion = lockFeet(free)));
  return motion;
}

/**
 * The made dancer's motion that is taken home, and drawn unless a newer one is on its way: as the model made it, or
 * with its feet locked. The same object as long as reaction and foot lock are the same.
 */
export function reactorMotion({
  reaction,
  footLock,
}: Pick<AppState, 'reaction' | 'footLock'>): SolvedMotion | null {
  return reaction && asDrawn(reaction.motion, footLock);
}

/** The motion of the coarse layer alone as it is drawn, or null while it is not to be seen. */
export function coarseMotion({
  coarse,
  overlays,
  footLock,
}: Pick<AppState, 'coarse' | 'overlays' | 'footLock'>): SolvedMotion | null {
  return overlays.ghost && coarse.motion ? asDrawn(coarse.motion, footLock) : null;
}

/** The same of the take that stands beside the one on the stage. */
export function otherCoarseMotion({
  coarse,
  overlays,
  footLock,
}: Pick<AppState, 'coarse' | 'overlays' | 'footLock'>): SolvedMotion | null {
  return overlays.ghost && coarse.other ? asDrawn(coarse.other, footLock) : null;
}

/** Keeps a motion whose feet were locked elsewhere, so that it is not done again. */
export function rememberLocked(free: SolvedMotion, motion: SolvedMotion): void {
  locked.set(free, motion);
}
