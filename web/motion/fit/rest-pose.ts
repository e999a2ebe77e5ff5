import { conjugate, readQuat, rotate } from '../math/quat';
import { rowDistance } from '../math/rows';
import { median, percentile } from '../math/statistics';
import { direction, length, readVec, scale, sub, type Vec3, writeVec, Y_AXIS } from '../math/vec3';
import { J, JOINT_COUNT, MIRROR, PARENTS } from '../skeleton/skeleton';
import type { TrunkRotations } from './trunk';

const framesOf = (observed: Float64Array): number => observed.length / (3 * JOINT_COUNT);

/** Reads one joint of one frame. */
function jointAt(observed: Float64Array, frame: number, joint: number): Vec3 {
  return readVec(observed, frame * JOINT_COUNT + joint);
}

/** Length of every joint's bone to its parent: median over time, the same left and right. */
function boneLengths(observed: Float64Array): number[] {
  const lengths = PARENTS.map((parent, joint) => {
    if (parent < 0) return 0;
    const overTime = new Float64Array(framesOf(observed));
    for (let frame = 0; frame < overTime.length; frame++) {
      const row = frame * JOINT_COUNT;
      overTime[frame] = rowDistance(observed, row + joint, observed, row + parent);
    }
    return median(overTime);
  });
  return lengths.map((own, joint) => (own + lengths[MIRROR[joint]!]!) / 2);
}

/** Median over time of a joint's bone in the axes of a body part, whose rotations are given frame by frame. */
function localBone(observed: Float64Array, joint: number, part: Float64Array): Vec3 {
  const axes = [0, 1, 2].map(() => new Float64Array(framesOf(observed)));
  for (let frame = 0; frame < framesOf(observed); frame++) {
    const bone = sub(jointAt(observed, frame, joint), jointAt(observed, frame, PARENTS[joint]!));
    const local = rotate(conjugate(readQuat(part, frame)), bone);
    for (let i = 0; i < 3; i++) axes[i]![frame] = local[i]!;
  }
  return [median(axes[0]!), median(axes[1]!), median(axes[2]!)];
}

/** Percentile of the toe's heights up to which a foot counts as standing. */
const STANDING_PERCENTILE = 25;

/** Slope of standing feet from ankle to toe, as the sine of the angle, -0.9 to 0. */
function toeDrop(observed: Float64Array): number {
  const sines = [J.left_foot, J.right_foot].flatMap((toe) => {
    const heights = Float64Array.from(
      { length: framesOf(observed) },
      (_, frame) => jointAt(observed, frame, toe)[1],
    );
    const standing = percentile(heights, STANDING_PERCENTILE);
    return [...heights.keys()].flatMap((frame) => {
      if (heights[frame]! > standing) return [];
      const foot = sub(jointAt(observed, frame, toe), jointAt(observed, frame, PARENTS[toe]!));
      return direction(foot, [0, 0, 1])[1];
    });
  });
  return Math.min(0, Math.max(-0.9, median(sines)));
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
  const directions = new Map<number, Vec3>();
  const side = (joint: number): number => (joint < MIRROR[joint]! ? 1 : -1);
  const keepShape = (joint: number, part: Float64Array): void => {
    const [own, other] = [localBone(observed, joint, part), localBone(observed, MIRROR[joint]!, part)];
    const across = (own[0] - other[0]) / 2;
    const [up, forwards] = [(own[1] + other[1]) / 2, (own[2] + other[2]) / 2];
    directions.set(MIRROR[joint]!, direction([-across, up, forwards], Y_AXIS));
    directions.set(joint, direction([across, up, forwards], Y_AXIS));
  };
  for (const joint of [J.left_hip, J.spine1]) keepShape(joint, pelvis);
  for (const joint of [J.left_collar, J.left_shoulder]) keepShape(joint, chest);
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
