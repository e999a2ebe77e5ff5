import {
  type BodyRule,
  type CapsuleBody,
  capsuleBody,
  candidatePairs,
  penetrationDepth,
} from '../motion/contact/capsules';
import { percentile } from '../motion/math/statistics';
import { distance, readVec } from '../motion/math/vec3';
import { JOINT_COUNT } from '../motion/skeleton/skeleton';
import { severity, type Measure, type Scale, worstMoments } from './moments';
import type { Duet, Rules } from './rules';

/** Distance and penetration of the dancers: `penetration` of training/evaluation/metrics/penetration.py and `root_distance` of distance.py. */
export interface Closeness {
  /** Share of frames with an overlap that is deeper than a touch: `ipr_capsules`. */
  readonly overlapShare: number;
  /** Deepest overlap, metres. */
  readonly deepest: number;
  /** Smallest distance between the roots, metres. */
  readonly closest: number;
}

/**
 * Deepest overlap of any capsule of one dancer with any of the other in every frame, metres, 0 where there is none:
 * `depth` of training/evaluation/metrics/penetration.py.
 */
export function overlapDepth({ leader, reactor, frames, fps }: Duet, rule: BodyRule): Float64Array {
  const [a, b] = [leader, reactor].map((positions) => capsuleBody({ fps, frames, positions }, rule)) as [
    CapsuleBody,
    CapsuleBody,
  ];
  return Float64Array.from({ length: frames }, (_, frame) =>
    penetrationDepth(a, b, candidatePairs(a, b, frame)),
  );
}

/** Factor over the limit at which an overlap has severity 2. */
const BAD_FACTOR = 5;
/** Severity of the distance between the roots, metres: below 1 at any distance, as only an overlap is past the limit. */
const DISTANCE_SCALE: Scale = { fine: 1.2, limit: 0, bad: -1 };

/** Closest distance and overlap of the two dancers. */
export function measureCloseness(duet: Duet, rules: Rules): Measure<Closeness> {
  const { deep } = rules.penetration;
  const depth = overlapDepth(duet, rules.penetration);
  const roots = rootDistance(duet);
  const scale: Scale = { fine: 0, limit: deep, bad: BAD_FACTOR * deep };
  const row = Float32Array.from(depth, (overlap, frame) =>
    Math.max(severity(overlap, scale), severity(roots[frame]!, DISTANCE_SCALE)),
  );
  return {
    whole: {
      overlapShare: depth.filter((overlap) => overlap > deep).length / duet.frames,
      deepest: percentile(depth, 100),
      closest: percentile(roots, 0),
    },
    rows: [row],
    worst: worstMoments(row, duet.fps, 'overlap', (frame) => depth[frame]!),
  };
}

/** Distance between the roots in every frame, metres: `root_distance` of training/evaluation/metrics/distance.py. */
function rootDistance({ leader, reactor, frames }: Duet): Float64Array {
  return Float64Array.from({ length: frames }, (_, frame) => {
    const root = frame * JOINT_COUNT;
    return distance(readVec(leader, root), readVec(reactor, root));
  });
}
