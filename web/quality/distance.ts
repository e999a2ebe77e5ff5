import { JOINT_COUNT } from '../motion/skeleton';
import { distance, readVec } from '../motion/vec3';
import type { Duet } from './rules';

/** Distance between the roots in every frame, metres: `root_distance` of training/evaluation/metrics/distance.py. */
export function rootDistance({ leader, reactor, frames }: Duet): Float64Array {
  return Float64Array.from({ length: frames }, (_, frame) => {
    const root = frame * JOINT_COUNT;
    return distance(readVec(leader, root), readVec(reactor, root));
  });
}
