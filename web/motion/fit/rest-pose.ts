import { rotateInverseInto } from '../math/flat-quaternions';
import { addInto, AXES, directionInto, distanceAt, subtractInto } from '../math/flat-vectors';
import { bodyFrameInto } from '../math/rigid';
import { J, JOINT_COUNT, MIRROR, PARENTS } from '../skeleton/skeleton';
import { median, percentile } from '../math/statistics';
import { direction, length, scale, type Vec3, writeVec, Y_AXIS } from '../math/vec3';

const ROW = 3 * JOINT_COUNT;

/** World rotations of the trunk's two rigid parts, frames x 4 each. */
export interface TrunkRotations {
  readonly pelvis: Float64Array;
  readonly chest: Float64Array;
}

/**
 * Rotations of pelvis and chest as the joints show them: of the pelvis x from hip to hip and y from the hips to the
 * spine, of the chest x from collar to collar and y from the upper spine to the neck.
 *
 * @param observed frames x 22 x 3, metres
 */
export function trunkRotations(observed: Float64Array): TrunkRotations {
  const frames = observed.length / ROW;
  const pelvis = new Float64Array(frames * 4);
  const chest = new Float64Array(frames * 4);
  const left = new Float64Array(3);
  const up = new Float64Array(3);
  for (let frame = 0; frame < frames; frame++) {
    const at = (joint: number): number => frame * ROW + 3 * joint;
    subtractInto(left, 0, observed, at(J.left_hip), observed, at(J.right_hip));
    // Up from the middle of the hips, which is the right hip and half of the way to the left one.
    subtractInto(up, 0, observed, at(J.spine1), observed, at(J.right_hip));
    addInto(up, 0, up, 0, left, 0, -0.5);
    bodyFrameInto(pelvis, 4 * frame, left, up);
    subtractInto(left, 0, observed, at(J.left_collar), observed, at(J.right_collar));
    subtractInto(up, 0, observed, at(J.neck), observed, at(J.spine3));
    bodyFrameInto(chest, 4 * frame, left, up);
  }
  return { pelvis, chest };
}

/** Length of every joint's bone to its parent: median over time, the same left and right. */
function boneLengths(observed: Float64Array): number[] {
  const overTime = new Float64Array(observed.length / ROW);
  const lengths = PARENTS.map((parent, joint) => {
    if (parent < 0) return 0;
    for (let frame = 0, row = 0; row < observed.length; frame++, row += ROW) {
      overTime[frame] = distanceAt(observed, row + 3 * joint, observed, row + 3 * parent);
    }
    return median(overTime);
  });
  return lengths.map((own, joint) => (own + lengths[MIRROR[joint]!]!) / 2);
}

/** Median over time of a joint's bone in the axes of a body part, whose rotations are frames x 4. */
function localBone(observed: Float64Array, joint: number, rotations: Float64Array): Vec3 {
  const frames = observed.length / ROW;
  const axes = [0, 1, 2].map(() => new Float64Array(frames)) as [Float64Array, Float64Array, Float64Array];
  const bone = new Float64Array(3);
  for (let frame = 0; frame < frames; frame++) {
    const row = frame * ROW;
    subtractInto(bone, 0, observed, row + 3 * joint, observed, row + 3 * PARENTS[joint]!);
    rotateInverseInto(bone, 0, rotations, 4 * frame, bone, 0);
    for (let axis = 0; axis < 3; axis++) axes[axis]![frame] = bone[axis]!;
  }
  return [median(axes[0]), median(axes[1]), median(axes[2])];
}

/** Percentile of the toe's heights up to which a foot counts as standing. */
const STANDING_PERCENTILE = 25;

/** Slope of standing feet from ankle to toe, as the sine of the angle, -0.9 to 0. */
function toeDrop(observed: Float64Array): number {
  const foot = new Float64Array(3);
  const sines = [J.left_foot, J.right_foot].flatMap((toe) => {
    const heights = Float64Array.from(
      { length: observed.length / ROW },
      (_, frame) => observed[frame * ROW + 3 * toe + 1]!,
    );
    const standing = percentile(heights, STANDING_PERCENTILE);
    const slopes: number[] = [];
    for (let frame = 0; frame < heights.length; frame++) {
      if (heights[frame]! > standing) continue;
      const row = frame * ROW;
      subtractInto(foot, 0, observed, row + 3 * toe, observed, row + 3 * PARENTS[toe]!);
      directionInto(foot, 0, foot, 0, AXES, 6);
      slopes.push(foot[1]!);
    }
    return slopes;
  });
  return Math.min(0, Math.max(-0.9, median(sines)));
}

/** Directions of a part's bones that keep the shape that the clip shows, mirrored left and right. */
function shapeOf(
  observed: Float64Array,
  joints: readonly number[],
  rotations: Float64Array,
): [number, Vec3][] {
  const bones = new Map(joints.map((joint) => [joint, localBone(observed, joint, rotations)]));
  return joints.map((joint) => {
    const own = bones.get(joint)!;
    const other = bones.get(MIRROR[joint]!)!;
    const mean: Vec3 = [(own[0] - other[0]) / 2, (own[1] + other[1]) / 2, (own[2] + other[2]) / 2];
    return [joint, direction(mean, Y_AXIS)];
  });
}

/**
 * The rest pose of a dancer's skeleton: a T-pose facing +z, arms along x, legs straight down, feet forward.
 *
 * Bones of pelvis and chest, and the shoulders, keep the shape that the clip shows; all others point where a T-pose
 * has them. Left and right mirror each other.
 *
 * @param observed frames x 22 x 3, metres
 * @returns 22 x 3 offsets from the parent in metres
 */
export function restOffsets(observed: Float64Array, { pelvis, chest }: TrunkRotations): Float32Array {
  const lengths = boneLengths(observed);
  const drop = toeDrop(observed);
  const forward = Math.sqrt(1 - drop * drop);
  const side = (joint: number): number => (joint < MIRROR[joint]! ? 1 : -1);
  const directions = new Map<number, Vec3>([
    ...shapeOf(observed, [J.left_hip, J.right_hip, J.spine1], pelvis),
    ...shapeOf(observed, [J.left_collar, J.right_collar, J.left_shoulder, J.right_shoulder], chest),
  ]);
  for (const joint of [J.left_knee, J.right_knee, J.left_ankle, J.right_ankle])
    directions.set(joint, [0, -1, 0]);
  for (const joint of [J.left_elbow, J.right_elbow, J.left_wrist, J.right_wrist]) {
    directions.set(joint, [side(joint), 0, 0]);
  }
  for (const joint of [J.left_foot, J.right_foot]) directions.set(joint, [0, drop, forward]);

  const offsets = new Float32Array(JOINT_COUNT * 3);
  for (let joint = 1; joint < JOINT_COUNT; joint++) {
    const towards = directions.get(joint) ?? Y_AXIS;
    writeVec(offsets, joint, scale(towards, lengths[joint]! / length(towards)));
  }
  return offsets;
}
