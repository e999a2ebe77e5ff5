import { smoothstep } from '../../motion/math/vec3';
import { ARMS } from '../../motion/skeleton/limbs';

/** Distance of two wrists up to which their link is fully visible, and from which on there is none, metres. */
const FULL = 0.5;
const NONE = 0.62;

/** Both hands of one dancer with both of the other. */
export const MAX_HAND_PAIRS = 2;

/** Two wrists near each other: their joints, their distance in metres, and the opacity of their link, 0 to 1. */
export interface HandPair {
  readonly leader: number;
  readonly reactor: number;
  readonly distance: number;
  readonly opacity: number;
}

/**
 * The hands of two dancers that are near each other: the nearest pair first, then the two other hands if they are near
 * too.
 *
 * @param leader joints, 22 x 3, metres
 * @param reactor joints, 22 x 3, metres
 */
export function nearHandPairs(leader: Float32Array, reactor: Float32Array): HandPair[] {
  const pairs = ARMS.flatMap(({ end: mine }) =>
    ARMS.map(({ end: theirs }) => ({
      leader: mine,
      reactor: theirs,
      distance: Math.hypot(
        ...[0, 1, 2].map((axis) => leader[mine * 3 + axis]! - reactor[theirs * 3 + axis]!),
      ),
    })),
  ).sort((a, b) => a.distance - b.distance);
  const nearest = pairs[0]!;
  const rest = pairs.find((pair) => pair.leader !== nearest.leader && pair.reactor !== nearest.reactor)!;
  return [nearest, rest].flatMap((pair) => {
    const opacity = 1 - smoothstep(FULL, NONE, pair.distance);
    return opacity > 0 ? [{ ...pair, opacity }] : [];
  });
}
