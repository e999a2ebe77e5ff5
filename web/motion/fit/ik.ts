import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { forwardKinematics } from '../skeleton/kinematics';
import { type Bones, bonesOf, fitPose, type Pose } from './pose-fit';
import {
  between,
  conjugate,
  fromAxes,
  multiply,
  negate,
  type Quat,
  quatDot,
  rotate,
  slerp,
  writeQuat,
} from '../math/quat';
import { restOffsets } from './rest-pose';
import { J, JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import { smoothHinges } from './twist';
import {
  add,
  cross,
  direction,
  distance,
  readVec,
  scale,
  sub,
  type Vec3,
  writeVec,
  Y_AXIS,
} from '../math/vec3';

/** A limb whose upper bone gets its twist from the hinge at its middle joint. */
interface Limb {
  readonly part: 'pelvis' | 'chest';
  readonly start: number;
  readonly middle: number;
  readonly end: number;
  readonly toe: number | null;
  /** Hinge axis in the rest pose, about which the limb bends. */
  readonly hinge: Vec3;
}

const LIMBS: readonly Limb[] = [
  {
    part: 'pelvis',
    start: J.left_hip,
    middle: J.left_knee,
    end: J.left_ankle,
    toe: J.left_foot,
    hinge: [1, 0, 0],
  },
  {
    part: 'pelvis',
    start: J.right_hip,
    middle: J.right_knee,
    end: J.right_ankle,
    toe: J.right_foot,
    hinge: [1, 0, 0],
  },
  {
    part: 'chest',
    start: J.left_shoulder,
    middle: J.left_elbow,
    end: J.left_wrist,
    toe: null,
    hinge: [0, -1, 0],
  },
  {
    part: 'chest',
    start: J.right_shoulder,
    middle: J.right_elbow,
    end: J.right_wrist,
    toe: null,
    hinge: [0, 1, 0],
  },
];

/** Weight of the foot's direction in the leg's twist, where a knee bent at a right angle has 1. */
const FOOT_WEIGHT = 0.3;

/** Hinge axis of a limb in world axes, one a frame. */
function hingesOf(limb: Limb, poses: readonly Pose[], bones: Bones): Vec3[] {
  const rest = direction(bones.offsets[limb.middle]!, Y_AXIS);
  const directions: Vec3[] = [];
  const observed: Vec3[] = [];
  const priors: Vec3[] = [];
  for (const pose of poses) {
    const inverse = conjugate(pose[limb.part]);
    const bone = (from: number, to: number): Vec3 =>
      direction(rotate(inverse, sub(pose.joints[to]!, pose.joints[from]!)), rest);
    const upper = bone(limb.start, limb.middle);
    const lower = bone(limb.middle, limb.end);
    let hinge = cross(upper, lower);
    if (limb.toe !== null) {
      hinge = add(hinge, scale(cross(bone(limb.end, limb.toe), lower), FOOT_WEIGHT));
    }
    directions.push(upper);
    observed.push(hinge);
    priors.push(rotate(between(rest, upper), limb.hinge));
  }
  return smoothHinges(directions, observed, priors).map((axis, t) => rotate(poses[t]![limb.part], axis));
}

/** World rotation of every joint of one pose, given the hinge axes of the four limbs. */
function worldRotations(pose: Pose, bones: Bones, hinges: readonly Vec3[]): Quat[] {
  const turns: Quat[] = [];
  const aimed = (base: Quat, from: number, to: number): Quat => {
    const rest = rotate(base, direction(bones.offsets[to]!, Y_AXIS));
    return multiply(between(rest, direction(sub(pose.joints[to]!, pose.joints[from]!), rest)), base);
  };
  turns[J.pelvis] = pose.pelvis;
  turns[J.spine1] = aimed(slerp(pose.pelvis, pose.chest, 1 / 3), J.spine1, J.spine2);
  turns[J.spine2] = aimed(slerp(pose.pelvis, pose.chest, 2 / 3), J.spine2, J.spine3);
  turns[J.spine3] = pose.chest;
  const neck = aimed(pose.chest, J.neck, J.head);
  turns[J.neck] = neck;
  // No joint position shows the head's own rotation: it is that of the neck.
  turns[J.head] = neck;
  turns[J.left_collar] = aimed(pose.chest, J.left_collar, J.left_shoulder);
  turns[J.right_collar] = aimed(pose.chest, J.right_collar, J.right_shoulder);
  LIMBS.forEach(({ start, middle, end, toe, hinge }, i) => {
    const rest = direction(bones.offsets[middle]!, Y_AXIS);
    const bone = direction(sub(pose.joints[middle]!, pose.joints[start]!), rest);
    const upper = multiply(fromAxes(hinges[i]!, bone), conjugate(fromAxes(hinge, rest)));
    turns[start] = upper;
    const lower = aimed(upper, middle, end);
    turns[middle] = lower;
    turns[end] = toe === null ? lower : aimed(lower, end, toe);
    if (toe !== null) turns[toe] = turns[end];
  });
  return turns;
}

/**
 * Inverse kinematics: fits a skeleton with constant bone lengths to joint positions and finds its rotations.
 *
 * Bone lengths are medians over time, the same left and right. In every frame the trunk is fitted as two rigid parts
 * joined by the spine, the limbs are fitted to the observed joints, and the root is where the squared error is least.
 * Twists of the limbs come from knees, feet and elbows and are smoothed over time; rotations that positions do not show
 * (wrists and head) are those of rest. Quaternions do not change sign from frame to frame. Pure.
 *
 * @param clip at least one frame
 * @param offsets of the skeleton, 22 x 3 metres, where they are known already
 */
export function solve(clip: MotionClip, offsets = restOffsets(clip)): SolvedMotion {
  const { frames, fps } = clip;
  const bones = bonesOf(offsets);
  const poses = Array.from({ length: frames }, (_, frame) => fitPose(clip, frame, bones));
  const hinges = LIMBS.map((limb) => hingesOf(limb, poses, bones));

  const root = new Float32Array(frames * 3);
  const rotations = new Float32Array(frames * JOINT_COUNT * 4);
  const previous: Quat[] = [];
  poses.forEach((pose, frame) => {
    writeVec(root, frame, pose.joints[J.pelvis]!);
    const turns = worldRotations(
      pose,
      bones,
      hinges.map((axes) => axes[frame]!),
    );
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const parent = PARENTS[joint]!;
      let local = parent < 0 ? turns[joint]! : multiply(conjugate(turns[parent]!), turns[joint]!);
      const before = previous[joint];
      if (before !== undefined && quatDot(before, local) < 0) local = negate(local);
      previous[joint] = local;
      writeQuat(rotations, frame * JOINT_COUNT + joint, local);
    }
  });
  const positions = forwardKinematics(offsets, root, rotations);
  let error = 0;
  for (let i = 0; i < frames * JOINT_COUNT; i++) {
    error += distance(readVec(positions, i), readVec(clip.positions, i));
  }
  return { fps, frames, offsets, root, rotations, positions, fitError: error / (frames * JOINT_COUNT) };
}
