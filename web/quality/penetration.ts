import { bodyHeight } from '../motion/scale';
import { J, JOINT_COUNT } from '../motion/skeleton';
import { percentile } from '../motion/statistics';
import { rootDistance } from './distance';
import { concern, type Measure, type Scale, worstMoments } from './moments';
import type { Duet, Rules } from './rules';
import { segmentDistance } from './segments';

/** How close the dancers come: `penetration` of training/metrics/penetration.py and `root_distance` of distance.py. */
export interface Closeness {
  /** Share of frames with an overlap that is deeper than a touch: `ipr_capsules`. */
  readonly overlapShare: number;
  /** Percentiles of the overlap over all frames, metres. */
  readonly depthP50: number;
  readonly depthP95: number;
  /** Deepest overlap, metres. */
  readonly deepest: number;
  /** Smallest distance between the roots, metres. */
  readonly closest: number;
}

/** The capsules of one dancer in every frame. */
interface Body {
  /** frames x capsules x 6: start and end of each axis. */
  readonly axes: Float64Array;
  /** frames x capsules x 4: middle of each axis, and the radius of the sphere around the whole capsule. */
  readonly spheres: Float64Array;
  readonly radii: readonly number[];
}

function bodyOf(positions: Float32Array, { frames, fps }: Duet, rule: Rules['penetration']): Body {
  const { capsules } = rule;
  const size = bodyHeight({ fps, frames, positions }) / rule.reference_height;
  const radii = capsules.map(({ radius }) => radius * size);
  const axes = new Float64Array(frames * capsules.length * 6);
  const spheres = new Float64Array(frames * capsules.length * 4);
  for (let frame = 0; frame < frames; frame++) {
    capsules.forEach(({ from, to, beyond }, index) => {
      const a = (frame * JOINT_COUNT + J[from]) * 3;
      const b = (frame * JOINT_COUNT + J[to]) * 3;
      const capsule = frame * capsules.length + index;
      let square = 0;
      for (let axis = 0; axis < 3; axis++) {
        const [first, last] = [positions[a + axis]!, positions[b + axis]!];
        // The skull sits on the neck's end.
        const start = beyond > 0 ? last : first;
        const end = last + (last - first) * beyond;
        axes[capsule * 6 + axis] = start;
        axes[capsule * 6 + 3 + axis] = end;
        spheres[capsule * 4 + axis] = (start + end) / 2;
        square += (end - start) ** 2;
      }
      spheres[capsule * 4 + 3] = Math.sqrt(square) / 2 + radii[index]!;
    });
  }
  return { axes, spheres, radii };
}

/**
 * Deepest overlap of any capsule of one dancer with any of the other in every frame, metres, 0 where there is none:
 * `depth` of training/metrics/penetration.py. Radii follow the size of each body.
 */
export function overlapDepth(duet: Duet, rule: Rules['penetration']): Float64Array {
  const [a, b] = [bodyOf(duet.leader, duet, rule), bodyOf(duet.reactor, duet, rule)];
  const count = rule.capsules.length;
  const depth = new Float64Array(duet.frames);
  for (let frame = 0; frame < duet.frames; frame++) {
    for (let i = 0; i < count; i++) {
      const p = frame * count + i;
      for (let j = 0; j < count; j++) {
        const q = frame * count + j;
        // Only pairs whose bounding spheres meet can overlap: a few in a hundred.
        const x = a.spheres[p * 4]! - b.spheres[q * 4]!;
        const y = a.spheres[p * 4 + 1]! - b.spheres[q * 4 + 1]!;
        const z = a.spheres[p * 4 + 2]! - b.spheres[q * 4 + 2]!;
        const reach = a.spheres[p * 4 + 3]! + b.spheres[q * 4 + 3]!;
        if (x * x + y * y + z * z >= reach * reach) continue;
        const gap = segmentDistance(a.axes, p * 6, b.axes, q * 6);
        depth[frame] = Math.max(depth[frame]!, a.radii[i]! + b.radii[j]! - gap);
      }
    }
  }
  return depth;
}

/** An overlap this much deeper than a touch is a clear fault. */
const BAD = 5;
/** Roots this far apart, in metres, are no concern; nearer they tint the lane a little, but only overlap is a fault. */
const FAR: Scale = { fine: 1.2, limit: 0, bad: -1 };

/** Closest distance and overlap of the two dancers. */
export function measureCloseness(duet: Duet, rules: Rules): Measure<Closeness> {
  const { deep } = rules.penetration;
  const depth = overlapDepth(duet, rules.penetration);
  const roots = rootDistance(duet);
  const scale: Scale = { fine: 0, limit: deep, bad: BAD * deep };
  const row = Float32Array.from(depth, (overlap, frame) =>
    Math.max(concern(overlap, scale), concern(roots[frame]!, FAR)),
  );
  return {
    whole: {
      overlapShare: depth.filter((overlap) => overlap > deep).length / duet.frames,
      depthP50: percentile(depth, 50),
      depthP95: percentile(depth, 95),
      deepest: percentile(depth, 100),
      closest: percentile(roots, 0),
    },
    rows: [row],
    worst: worstMoments(row, duet.fps, 'overlap', (frame) => depth[frame]!),
  };
}
