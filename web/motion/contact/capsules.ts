import type { MotionClip } from '../skeleton/clip';
import { bodyHeight } from '../skeleton/scale';
import { segmentDistance } from '../math/segments';
import { J, JOINT_COUNT, type JointName } from '../skeleton/skeleton';

/** A capsule around a bone: a segment with a radius. */
interface Capsule {
  readonly from: JointName;
  readonly to: JointName;
  /** Metres, on a body of the reference height. */
  readonly radius: number;
  /** Where above 0, the axis begins at the bone's end and goes on by this share of the bone's length (the skull). */
  readonly beyond: number;
}

/** The capsules of a body, the same as in training/evaluation/metrics/penetration.py. */
export interface BodyRule {
  readonly capsules: readonly Capsule[];
  /** Body height (scale.ts) of the radii's body, metres. */
  readonly reference_height: number;
  /** Depth from which an overlap counts as penetration; a shallower one is a touch, metres. */
  readonly deep: number;
}

/** The capsules of one dancer in every frame, or in one frame of several. */
export interface CapsuleBody {
  /** frames x capsules x 6: start and end of each axis. */
  readonly axes: Float64Array;
  /** frames x capsules x 4: middle of each axis, and the radius of the sphere around the whole capsule. */
  readonly spheres: Float64Array;
  /** One a capsule, metres, scaled with the body's height. */
  readonly radii: readonly number[];
}

/**
 * The capsules around the bones of a clip of at least one frame.
 * @param step frames from each of those that are wanted to the next
 */
export function capsuleBody(clip: MotionClip, rule: BodyRule, step = 1): CapsuleBody {
  const { capsules, reference_height } = rule;
  const { positions } = clip;
  const frames = Math.ceil(clip.frames / step);
  const size = bodyHeight(clip) / reference_height;
  const radii = capsules.map(({ radius }) => radius * size);
  const axes = new Float64Array(frames * capsules.length * 6);
  const spheres = new Float64Array(frames * capsules.length * 4);
  capsules.forEach(({ from, to, beyond }, index) => {
    const [first, last] = [3 * J[from], 3 * J[to]];
    for (let frame = 0; frame < frames; frame++) {
      const row = frame * step * JOINT_COUNT * 3;
      const capsule = frame * capsules.length + index;
      let square = 0;
      for (let axis = 0; axis < 3; axis++) {
        const a = positions[row + first + axis]!;
        const b = positions[row + last + axis]!;
        const start = beyond > 0 ? b : a;
        const end = b + (b - a) * beyond;
        axes[capsule * 6 + axis] = start;
        axes[capsule * 6 + 3 + axis] = end;
        spheres[capsule * 4 + axis] = (start + end) / 2;
        square += (end - start) ** 2;
      }
      spheres[capsule * 4 + 3] = Math.sqrt(square) / 2 + radii[index]!;
    }
  });
  return { axes, spheres, radii };
}

/** A capsule of one dancer and one of the other, as rows of their `axes` and `spheres`, and the sum of their radii. */
interface CapsulePair {
  readonly a: number;
  readonly b: number;
  readonly radii: number;
}

/**
 * Broad phase of the collision test: the pairs of capsules that may overlap in a frame, those whose bounding spheres
 * overlap. A few in a hundred remain.
 */
export function candidatePairs(a: CapsuleBody, b: CapsuleBody, frame: number): CapsulePair[] {
  const pairs: CapsulePair[] = [];
  a.radii.forEach((first, i) => {
    const p = frame * a.radii.length + i;
    b.radii.forEach((second, j) => {
      const q = frame * b.radii.length + j;
      const gapX = a.spheres[p * 4]! - b.spheres[q * 4]!;
      const gapY = a.spheres[p * 4 + 1]! - b.spheres[q * 4 + 1]!;
      const gapZ = a.spheres[p * 4 + 2]! - b.spheres[q * 4 + 2]!;
      const limit = a.spheres[p * 4 + 3]! + b.spheres[q * 4 + 3]!;
      if (gapX * gapX + gapY * gapY + gapZ * gapZ < limit * limit)
        pairs.push({ a: p, b: q, radii: first + second });
    });
  });
  return pairs;
}

/** Narrow phase of the collision test: the deepest overlap of these pairs, metres, 0 where there is none. */
export function penetrationDepth(a: CapsuleBody, b: CapsuleBody, pairs: readonly CapsulePair[]): number {
  let depth = 0;
  for (const pair of pairs) {
    depth = Math.max(depth, pair.radii - segmentDistance(a.axes, pair.a * 6, b.axes, pair.b * 6));
  }
  return depth;
}

/** Level shifts of equal x, metres, by ascending z. */
export interface ShiftColumn {
  /** Number of shifts with a smaller x. */
  readonly first: number;
  readonly x: number;
  readonly z: Float64Array;
}

/**
 * Deepest overlap of two dancers in a frame for each of many level shifts of the second one.
 *
 * @param columns the shifts by ascending x, n in all
 * @returns n depths, metres, 0 where there is no overlap
 */
export function shiftedDepths(
  a: CapsuleBody,
  b: CapsuleBody,
  frame: number,
  columns: readonly ShiftColumn[],
): Float64Array {
  const last = columns.at(-1)!;
  const depths = new Float64Array(last.first + last.z.length);
  a.radii.forEach((first, i) => {
    const p = (frame * a.radii.length + i) * 6;
    b.radii.forEach((second, j) => {
      deepen(depths, first + second, a.axes, p, b.axes, (frame * b.radii.length + j) * 6, columns);
    });
  });
  return depths;
}

/**
 * Raises the depths to those of one pair of capsules. The boxes around two axes are at most as far apart as the axes:
 * where even the boxes leave no room for a deeper overlap, the distance of the axes is not computed.
 */
function deepen(
  depths: Float64Array,
  radii: number,
  a: Float64Array,
  p: number,
  b: Float64Array,
  q: number,
  columns: readonly ShiftColumn[],
): void {
  const gapY = Math.max(0, gapAfter(a, p + 1, b, q + 1), gapAfter(b, q + 1, a, p + 1));
  if (gapY >= radii) return;
  const [afterX, beforeX] = [gapAfter(a, p, b, q), gapAfter(b, q, a, p)];
  const [afterZ, beforeZ] = [gapAfter(a, p + 2, b, q + 2), gapAfter(b, q + 2, a, p + 2)];
  const reachX = Math.sqrt(radii * radii - gapY * gapY);
  for (const { first, x, z: column } of columns) {
    if (x <= beforeX - reachX) continue;
    if (x >= reachX - afterX) break;
    const gapX = Math.max(0, afterX + x, beforeX - x);
    const square = gapX * gapX + gapY * gapY;
    const reachZ = Math.sqrt(radii * radii - square);
    for (let k = 0; k < column.length; k++) {
      const z = column[k]!;
      if (z <= beforeZ - reachZ) continue;
      if (z >= reachZ - afterZ) break;
      const gapZ = Math.max(0, afterZ + z, beforeZ - z);
      const reach = radii - depths[first + k]!;
      if (square + gapZ * gapZ >= reach * reach) continue;
      depths[first + k] = Math.max(depths[first + k]!, radii - segmentDistance(a, p, b, q, x, z));
    }
  }
}

/** How far the box around the segment b begins after the end of the one around a along an axis; below 0 where it does not. */
function gapAfter(a: Float64Array, p: number, b: Float64Array, q: number): number {
  return Math.min(b[q]!, b[q + 3]!) - Math.max(a[p]!, a[p + 3]!);
}
