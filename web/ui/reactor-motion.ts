import type { SolvedMotion } from '../motion/clip';
import { lockFeet } from '../motion/foot-lock';
import type { AppState } from './state';

/** Locked motions by the free ones that they were made from; they go when those go. */
const locked = new WeakMap<SolvedMotion, SolvedMotion>();

/**
 * The reactor's motion that is drawn and taken home: as the model made it, or with its feet locked. The same object
 * as long as reaction and foot lock are the same.
 */
export function reactorMotion({
  reaction,
  footLock,
}: Pick<AppState, 'reaction' | 'footLock'>): SolvedMotion | null {
  if (!reaction) return null;
  const free = reaction.motion;
  if (!footLock) return free;
  let motion = locked.get(free);
  if (!motion) locked.set(free, (motion = lockFeet(free)));
  return motion;
}
