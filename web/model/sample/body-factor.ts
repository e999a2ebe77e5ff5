import { FPS } from '../../motion/skeleton/clip';
import { CROWN, restPositions, SOLE, standingHeight } from '../../motion/skeleton/kinematics';
import { bodyHeight } from '../../motion/skeleton/scale';
import type { Manifest } from '../manifest';
import type { SolveSettings, Source } from './inputs';

/**
 * By what the decoded body is multiplied, so that the dancer has the height that was asked for; by default the one that
 * the couples of the training had in proportion, because bones are decoded shorter than they were captured.
 *
 * @param offsets of the role's body, 22 x 3 metres at the leader's size
 * @param scale by what the loaded dancer was multiplied to reach the model's reference height
 */
export function bodyFactor(
  offsets: Float32Array,
  scale: number,
  { height, role }: Pick<SolveSettings, 'height'> & Pick<Source, 'role'>,
  { reference_height, reactor_height }: Manifest['skeleton'],
): number {
  // What is under the toes and above the head keeps its size.
  const fixed = SOLE + CROWN;
  if (height !== undefined) return (height - fixed) / (standingHeight(offsets) - fixed);
  const proportion = reactor_height / reference_height;
  const wanted = (reference_height / scale) * (role === 'leader' ? 1 / proportion : proportion);
  return wanted / bodyHeight({ fps: FPS, frames: 1, positions: restPositions(offsets) });
}
