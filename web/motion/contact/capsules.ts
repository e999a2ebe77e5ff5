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
  for (let frame = 0; frame < frames; frame++) {
    capsules.forEach(({ from, to, beyond }, index) => {
      const a = (frame * JOINT_COUNT + J[from]) * 3;
      const b = (frame * JOINT_COUNT + J[to]) * 3;
      const capsule = frame * capsules.length + index;
      let square = 0;
      for (let axis = 0; axis < 3; axis++) {
        const [first, last] = [positions[a + axis]!, positions[b + axis]!];
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

/** A capsule of one dancer and one of the other, as rows of their `axes` and `spheres`, and the sum of their radii. */
interface CapsulePair {
  readonly a: number;
  readonly b: number;
  readonly radii: number;
}

/** Whether the bounding spheres of two capsules come within `margin` metres, the second one shifted level by x, z. */
function spheresOverlap(
  { spheres: a }: CapsuleBody,
  p: number,
  { spheres: b }: CapsuleBody,
  q: number,
  x: number,
  z: number,
  margin: number,
): boolean {
  const gapX = a[p * 4]! - b[q * 4]! - x;
  const gapY = a[p * 4 + 1]! - b[q * 4 + 1]!;
  const gapZ = a[p * 4 + 2]! - b[q * 4 + 2]! - z;
  const limit = a[p * 4 + 3]! + b[q * 4 + 3]! + margin;
  return gapX * gapX + gapY * gapY + gapZ * gapZ < limit * limit;
}

/**
 * Broad phase of the collision test: the pairs of capsules that may overlap in a frame if one dancer is shifted by up to
 * `margin` metres, those whose bounding spheres come that near. A few in a hundred remain.
 */
export function candidatePairs(a: CapsuleBody, b: CapsuleBody, frame: number, margin = 0): CapsulePair[] {
  const pairs: CapsulePair[] = [];
  a.radii.forEach((first, i) => {
    const p = frame * a.radii.length + i;
    b.radii.forEach((second, j) => {
      const q = frame * b.radii.length + j;
      if (spheresOverlap(a, p, b, q, 0, 0, margin)) pairs.push({ a: p, b: q, radii: first + second });
    });
  });
  return pairs;
}

/**
 * Narrow phase of the collision test: the deepest overlap of these pairs, metres, 0 where there is none.
 * @param x with `z`: level shift of the second dancer, metres
 */
export function penetrationDepth(
  a: CapsuleBody,
  b: CapsuleBody,
  pairs: readonly CapsulePair[],
  x = 0,
  z = 0,
): number {
  let depth = 0;
  for (const pair of pairs) {
    if (!spheresOverlap(a, pair.a, b, pair.b, x, z, 0)) continue;
    depth = Math.max(depth, pair.radii - segmentDistance(a.axes, pair.a * 6, b.axes, pair.b * 6, x, z));
  }
  return depth;
}
