import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { bringDown } from './bring-down';
import { avoidCollisions } from './collision-avoidance';
import { limitRootSpeed } from './root-speed';

/**
 * What a dancer keeps to beside a partner: moved out of the partner's body, no faster over the floor than dancers go,
 * and brought down where they stay off the floor. Pure.
 *
 * @param partner of the same frames and rate
 * @param bodies capsules of both bodies
 */
export function besidePartner(
  motion: SolvedMotion,
  partner: MotionClip,
  bodies: Parameters<typeof avoidCollisions>[2],
): SolvedMotion {
  return bringDown(limitRootSpeed(avoidCollisions(motion, partner, bodies), partner));
}
