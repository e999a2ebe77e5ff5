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

/** The capsules around the bones of a clip of at least one frame. */
export function capsuleBody(clip: MotionClip, rule: BodyRule): CapsuleBody {
  const { capsules, reference_height } = rule;
  const { positions, frames } = clip;
  const size = bodyHeight(clip) / reference_height;
  const radii = capsules.map(({ radius }) => radius * size);
  const axes = new Float64Array(frames * capsules.length * 6);
  const spheres = new Float64Array(frames * capsules.length * 4);
  capsules.forEach(({ from, to, beyond }, index) => {
    const [first, last] = [3 * J[from], 3 * J[to]];
    for (let frame = 0; frame < frames; frame++) {
      const row = frame * JOINT_COUNT * 3;
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
 * @param reach length up to which one of the bodies may be shifted, metres
 */
export function candidatePairs(a: CapsuleBody, b: CapsuleBody, frame: number, reach = 0): CapsulePair[] {
  const pairs: CapsulePair[] = [];
  const [rows, columns] = [a.radii.length, b.radii.length];
  for (let p = frame * rows; p < (frame + 1) * rows; p++) {
    for (let q = frame * columns; q < (frame + 1) * columns; q++) {
      const gapX = a.spheres[p * 4]! - b.spheres[q * 4]!;
      const gapY = a.spheres[p * 4 + 1]! - b.spheres[q * 4 + 1]!;
      const gapZ = a.spheres[p * 4 + 2]! - b.spheres[q * 4 + 2]!;
      const limit = a.spheres[p * 4 + 3]! + b.spheres[q * 4 + 3]! + reach;
      if (gapX * gapX + gapY * gapY + gapZ * gapZ < limit * limit)
        pairs.push({ a: p, b: q, radii: a.radii[p - frame * rows]! + b.radii[q - frame * columns]! });
    }
  }
  return pairs;
}

/** A vector level with the floor. */
export interface LevelVector {
  readonly x: number;
  readonly z: number;
}

/**
 * Narrow phase of the collision test: the deepest overlap of these pairs, metres, 0 where there is none.
 * @param shift of the second body, level with the floor, metres
 */
export function penetrationDepth(
  a: CapsuleBody,
  b: CapsuleBody,
  pairs: readonly CapsulePair[],
  { x, z }: LevelVector = { x: 0, z: 0 },
): number {
  let depth = 0;
  for (const pair of pairs) {
    depth = Math.max(depth, pair.radii - segmentDistance(a.axes, pair.a * 6, b.axes, pair.b * 6, x, z));
  }
  return depth;
}
