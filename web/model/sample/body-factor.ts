import type { MotionClip } from '../../motion/skeleton/clip';
import { CROWN, restPositions, SOLE, standingHeight } from '../../motion/skeleton/kinematics';
import { bodyHeight } from '../../motion/skeleton/scale';
import type { Manifest } from '../manifest';
import type { Size, Source } from './inputs';

/**
 * By what the decoded body is multiplied, so that the dancer has the height that was asked for; by default the one that
 * the couples of the training had in proportion, because bones are decoded shorter than they were captured.
 *
 * @param offsets of the role's body, 22 x 3 metres at the leader's size
 * @param leader the loaded dancer at their own size
 */
export function bodyFactor(
  offsets: Float32Array,
  leader: MotionClip,
  { height, role }: Size & Pick<Source, 'role'>,
  { reference_height, reactor_height }: Manifest['skeleton'],
): number {
  // What is under the toes and above the head keeps its size.
  const fixed = SOLE + CROWN;
  if (height !== undefined) return (height - fixed) / (standingHeight(offsets) - fixed);
  if (reactor_height === undefined) return 1;
  const proportion = reactor_height / reference_height;
  const wanted = bodyHeight(leader) * (role === 'leader' ? 1 / proportion : proportion);
  return wanted / bodyHeight({ fps: leader.fps, frames: 1, positions: restPositions(offsets) });
}
