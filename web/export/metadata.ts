import { PARENTS, SMPL22 } from '../motion/skeleton/skeleton';
import { type Dance, firstMotion } from './dance';

/** All that is to be said about a dance but its numbers, so that a file explains itself. */
export function described(dance: Dance): object {
  const { fps, frames } = firstMotion(dance);
  return {
    format: 'reactdance-motion',
    version: 1,
    units: { position: 'metres', time: 'seconds' },
    axes: 'y up, right-handed; standing toes are at height 0',
    fps,
    frames,
    dancers: dance.dancers.map(({ role }) => role),
    joints: SMPL22,
    parents: PARENTS,
    ...dance.about,
  };
}
