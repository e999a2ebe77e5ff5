import type { MotionClip } from '../skeleton/clip';
import { bodyHeight } from '../skeleton/scale';
import { segmentPair, squaredDistance } from '../math/segments';
import { J, JOINT_COUNT, type JointName } from '../skeleton/skeleton';

/** A capsule around a bone: a segment with a radius. */
export interface Capsule {
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

/** The capsules of one dancer in every frame. */
export interface CapsuleBody {
  /** frames x capsules x 6: start and end of each axis. */
  readonly axes: Float64Array;
  /** frames x capsules x 4: middle of each axis, and the radius of the sphere around the whole capsule. */
  readonly spheres: Float64Array;
  /** One a capsule, metres, scaled with the body's height. */
  readonly radii: readonly number[];
}

/** The capsules around the bones of a clip of at least one frame. */
export function capsuleBody(clip: MotionClip, { capsules, reference_height }: BodyRule): CapsuleBody {
  const { frames, positions } = clip;
  const size = bodyHeight(clip) / reference_height;
  const radii = capsules.map(({ radius }) => radius * size);
  const axes = new Float64Array(frames * capsules.length * 6);
  const spheres = new Float64Array(frames * capsules.length * 4);
  capsules.forEach(({ from, to, beyond }, index) => {
    for (let frame = 0; frame < frames; frame++) {
      const a = (frame * JOINT_COUNT + J[from]) * 3;
      const b = (frame * JOINT_COUNT + J[to]) * 3;
      const capsule = frame * capsules.length + index;
      let square = 0;
      for (let axis = 0; axis < 3; axis++) {
        const first = positions[a + axis]!;
        const last = positions[b + axis]!;
        const start = beyond > 0 ? last : first;
        const end = last + (last - first) * beyond;
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
export interface CapsulePair {
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
  const [first, second] = [a.spheres, b.spheres];
  for (let i = 0; i < a.radii.length; i++) {
    const p = frame * a.radii.length + i;
    for (let j = 0; j < b.radii.length; j++) {
      const q = frame * b.radii.length + j;
      const gapX = first[p * 4]! - second[q * 4]!;
      const gapY = first[p * 4 + 1]! - second[q * 4 + 1]!;
      const gapZ = first[p * 4 + 2]! - second[q * 4 + 2]!;
      const limit = first[p * 4 + 3]! + second[q * 4 + 3]!;
      if (gapX * gapX + gapY * gapY + gapZ * gapZ < limit * limit) {
        pairs.push({ a: p, b: q, radii: a.radii[i]! + b.radii[j]! });
      }
    }
  }
  return pairs;
}

/** Narrow phase of the collision test: the deepest overlap of these pairs, metres, 0 where there is none. */
export function penetrationDepth(a: CapsuleBody, b: CapsuleBody, pairs: readonly CapsulePair[]): number {
  let depth = 0;
  for (const pair of pairs) {
    const square = squaredDistance(segmentPair(a.axes, pair.a * 6, b.axes, pair.b * 6));
    depth = Math.max(depth, pair.radii - Math.sqrt(square));
  }
  return depth;
}

/** Level shifts of equal x, metres. */
export interface ShiftColumn {
  readonly x: number;
  readonly z: Float64Array;
}

/**
 * How far the second of two segments has to be shifted along an axis until it begins where the first one ends. With
 * the segments swapped it is the same for the other direction, and the larger of the two is the gap between them.
 */
function gapAfter(a: Float64Array, p: number, b: Float64Array, q: number): number {
  return Math.min(b[q]!, b[q + 3]!) - Math.max(a[p]!, a[p + 3]!);
}

/**
 * Deepest overlap of two dancers in a frame with the second one shifted level with the floor by each of many shifts.
 *
 * @param columns the shifts, n in all
 * @returns n depths, metres, 0 where there is no overlap
 */
export function shiftedDepths(
  a: CapsuleBody,
  b: CapsuleBody,
  frame: number,
  columns: readonly ShiftColumn[],
): Float64Array {
  const depths = new Float64Array(columns.reduce((count, { z }) => count + z.length, 0));
  for (let i = 0; i < a.radii.length; i++) {
    for (let j = 0; j < b.radii.length; j++) deepen(depths, a, i, b, j, frame, columns);
  }
  return depths;
}

/**
 * Raises the depths by those of one pair of capsules. The boxes around two axes are at most as far apart as the axes:
 * where even boxes leave no room for a deeper overlap, the distance of the axes is not computed.
 */
function deepen(
  depths: Float64Array,
  { axes: a, radii: first }: CapsuleBody,
  i: number,
  { axes: b, radii: second }: CapsuleBody,
  j: number,
  frame: number,
  columns: readonly ShiftColumn[],
): void {
  const p = (frame * first.length + i) * 6;
  const q = (frame * second.length + j) * 6;
  const radii = first[i]! + second[j]!;
  const gapY = Math.max(0, gapAfter(a, p + 1, b, q + 1), gapAfter(b, q + 1, a, p + 1));
  if (gapY >= radii) return;
  const [afterX, beforeX] = [gapAfter(a, p, b, q), gapAfter(b, q, a, p)];
  const [afterZ, beforeZ] = [gapAfter(a, p + 2, b, q + 2), gapAfter(b, q + 2, a, p + 2)];
  const segments = segmentPair(a, p, b, q);
  let shift = 0;
  for (const { x, z: column } of columns) {
    const gapX = Math.max(0, afterX + x, beforeX - x);
    const square = gapX * gapX + gapY * gapY;
    const near = square < radii * radii;
    for (let k = 0; near && k < column.length; k++) {
      const z = column[k]!;
      const gapZ = Math.max(0, afterZ + z, beforeZ - z);
      const reach = radii - depths[shift + k]!;
      if (square + gapZ * gapZ >= reach * reach) continue;
      depths[shift + k] = Math.max(radii - Math.sqrt(squaredDistance(segments, x, z)), depths[shift + k]!);
    }
    shift += column.length;
  }
}
