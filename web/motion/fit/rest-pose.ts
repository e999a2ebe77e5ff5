import type { MotionClip } from '../skeleton/clip';
import { conjugate, type Quat, rotate } from '../math/quat';
import { bodyFrame } from '../math/rigid';
import { J, JOINT_COUNT, MIRROR, PARENTS } from '../skeleton/skeleton';
import { median, percentile } from '../math/statistics';
import {
  direction,
  distance,
  length,
  lerp,
  readVec,
  scale,
  sub,
  type Vec3,
  writeVec,
  Y_AXIS,
} from '../math/vec3';

/** Reads one joint of one frame. */
export function jointAt(clip: MotionClip, frame: number, joint: number): Vec3 {
  return readVec(clip.positions, frame * JOINT_COUNT + joint);
}

/** Pelvis orientation of a frame: x from hip to hip, y from the hips to the spine. */
export function pelvisFrame(clip: MotionClip, frame: number): Quat {
  const left = jointAt(clip, frame, J.left_hip);
  const right = jointAt(clip, frame, J.right_hip);
  return bodyFrame(sub(left, right), sub(jointAt(clip, frame, J.spine1), lerp(left, right, 0.5)));
}

/** Chest orientation of a frame: x from collar to collar, y from the upper spine to the neck. */
export function chestFrame(clip: MotionClip, frame: number): Quat {
  const across = sub(jointAt(clip, frame, J.left_collar), jointAt(clip, frame, J.right_collar));
  return bodyFrame(across, sub(jointAt(clip, frame, J.neck), jointAt(clip, frame, J.spine3)));
}

/** Length of every joint's bone to its parent: median over time, the same left and right. */
function boneLengths(clip: MotionClip): number[] {
  const lengths = PARENTS.map((parent, joint) => {
    if (parent < 0) return 0;
    const overTime = new Float64Array(clip.frames);
    for (let frame = 0; frame < clip.frames; frame++) {
      overTime[frame] = distance(jointAt(clip, frame, joint), jointAt(clip, frame, parent));
    }
    return median(overTime);
  });
  return lengths.map((own, joint) => (own + lengths[MIRROR[joint]!]!) / 2);
}

/** Median over time of a joint's bone in the axes of a body part, whose inverse rotations are given frame by frame. */
function localBone(clip: MotionClip, joint: number, inverses: readonly Quat[]): Vec3 {
  const axes = [0, 1, 2].map(() => new Float64Array(clip.frames));
  inverses.forEach((inverse, frame) => {
    const bone = sub(jointAt(clip, frame, joint), jointAt(clip, frame, PARENTS[joint]!));
    rotate(inverse, bone).forEach((value, i) => (axes[i]![frame] = value));
  });
  return [median(axes[0]!), median(axes[1]!), median(axes[2]!)];
}

/** Percentile of the toe's heights up to which a foot counts as standing. */
const STANDING_PERCENTILE = 25;

/** Slope of standing feet from ankle to toe, as the sine of the angle, -0.9 to 0. */
function toeDrop(clip: MotionClip): number {
  const sines = [J.left_foot, J.right_foot].flatMap((toe) => {
    const heights = Float64Array.from({ length: clip.frames }, (_, frame) => jointAt(clip, frame, toe)[1]);
    const standing = percentile(heights, STANDING_PERCENTILE);
    return [...heights.keys()].flatMap((frame) => {
      if (heights[frame]! > standing) return [];
      const foot = sub(jointAt(clip, frame, toe), jointAt(clip, frame, PARENTS[toe]!));
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
 * @returns 22 x 3 offsets from the parent in metres
 */
export function restOffsets(clip: MotionClip): Float32Array {
  const lengths = boneLengths(clip);
  const drop = toeDrop(clip);
  const forward = Math.sqrt(1 - drop * drop);
  const inversesOf = (frameOf: typeof pelvisFrame): Quat[] =>
    Array.from({ length: clip.frames }, (_, frame) => conjugate(frameOf(clip, frame)));
  const shape = (joint: number, inverses: readonly Quat[]): Vec3 => {
    const own = localBone(clip, joint, inverses);
    const other = localBone(clip, MIRROR[joint]!, inverses);
    return direction([(own[0] - other[0]) / 2, (own[1] + other[1]) / 2, (own[2] + other[2]) / 2], Y_AXIS);
  };
  const side = (joint: number): number => (joint < MIRROR[joint]! ? 1 : -1);
  const directions = new Map<number, Vec3>();
  const pelvis = inversesOf(pelvisFrame);
  for (const joint of [J.left_hip, J.right_hip, J.spine1]) directions.set(joint, shape(joint, pelvis));
  const chest = inversesOf(chestFrame);
  for (const joint of [J.left_collar, J.right_collar, J.left_shoulder, J.right_shoulder]) {
    directions.set(joint, shape(joint, chest));
  }
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
