import { J } from '../../motion/skeleton/skeleton';
import { ramp } from '../body/field';

/** Wrists closer than this are surely within reach of each other, metres; the link fades up to `LOOSE`. */
const CLOSE = 0.5;
const LOOSE = 0.62;
const WRISTS = [J.left_wrist, J.right_wrist] as const;

/** Both hands of one with both of the other. */
export const MOST_HOLDS = 2;

/** Two wrists within reach: which joints, how far apart in metres, and how much of the link is to be seen. */
export interface Hold {
  readonly leader: number;
  readonly reactor: number;
  readonly gap: number;
  readonly strength: number;
}

/**
 * The nearest hands of the two that are within reach: the nearest pair first, then the other pair if it is too. No hand
 * is in two pairs.
 *
 * @param leader joints, 22 x 3, metres
 * @param reactor joints, 22 x 3, metres
 */
export function holds(leader: Float32Array, reactor: Float32Array): Hold[] {
  const gaps = WRISTS.flatMap((mine) =>
    WRISTS.map((theirs) => ({
      leader: mine,
      reactor: theirs,
      gap: Math.hypot(...[0, 1, 2].map((axis) => leader[mine * 3 + axis]! - reactor[theirs * 3 + axis]!)),
    })),
  ).sort((a, b) => a.gap - b.gap);
  const nearest = gaps[0]!;
  const rest = gaps.find((pair) => pair.leader !== nearest.leader && pair.reactor !== nearest.reactor)!;
  return [nearest, rest].flatMap((pair) => {
    const strength = 1 - ramp(CLOSE, LOOSE, pair.gap);
    return strength > 0 ? [{ ...pair, strength }] : [];
  });
}
