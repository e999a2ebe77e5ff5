import type { MotionClip } from '../skeleton/clip';
import type { Quat } from '../math/quat';
import { rotate } from '../math/quat';
import { chestFrame, jointAt, pelvisFrame } from './rest-pose';
import { fitRotation } from '../math/rigid';
import { J, JOINT_COUNT } from '../skeleton/skeleton';
import { add, direction, lerp, readVec, scale, sub, type Vec3, ZERO } from '../math/vec3';

/** One frame on the skeleton of constant bone lengths: joint positions, and rotations of the trunk's two rigid parts. */
export interface Pose {
  readonly joints: readonly Vec3[];
  readonly pelvis: Quat;
  readonly chest: Quat;
}

/** Rest skeleton: offsets from the parent as vectors, and their lengths, metres. */
export interface Bones {
  readonly offsets: readonly Vec3[];
  readonly lengths: readonly number[];
}

export function bonesOf(offsets: Float32Array): Bones {
  const vectors = Array.from({ length: JOINT_COUNT }, (_, joint) => readVec(offsets, joint));
  return { offsets: vectors, lengths: vectors.map((v) => Math.hypot(...v)) };
}

const LIMBS = [
  [J.left_hip, J.left_knee, J.left_ankle, J.left_foot],
  [J.right_hip, J.right_knee, J.right_ankle, J.right_foot],
  [J.left_shoulder, J.left_elbow, J.left_wrist],
  [J.right_shoulder, J.right_elbow, J.right_wrist],
] as const;

const PELVIS_PART = [J.left_hip, J.right_hip, J.spine1];
const CHEST_PART = [J.neck, J.left_collar, J.right_collar];

/** Sweeps of `fitLimb`; each halves what the bone lengths leave of the error at the end of the limb. */
const LIMB_SWEEPS = 3;
/** Passes that move the root by the mean error of the joints. */
const ROOT_PASSES = 2;

/** The point at `length` metres from `origin` in the direction of `target`. */
function aim(origin: Vec3, target: Vec3, length: number, fallback: Vec3): Vec3 {
  return add(origin, scale(direction(sub(target, origin), fallback), length));
}

/**
 * Middle joint of a two-bone limb (knee, elbow), so that both it and the end are near the observed ones.
 *
 * Sweeps as in FABRIK (Aristidou and Lasenby 2011): place the middle from the end, take the mean with the observed one,
 * restore the upper bone's length. An exact solution for the end would be worse: near a straight limb a millimetre at
 * the end moves the knee by centimetres.
 */
function fitLimb(origin: Vec3, middle: Vec3, end: Vec3, upper: number, lower: number, fallback: Vec3): Vec3 {
  let fitted = aim(origin, middle, upper, fallback);
  for (let sweep = 0; sweep < LIMB_SWEEPS; sweep++) {
    const fromEnd = aim(end, fitted, lower, scale(fallback, -1));
    fitted = aim(origin, lerp(middle, fromEnd, 0.5), upper, fallback);
  }
  return fitted;
}

function fitFrom(clip: MotionClip, frame: number, bones: Bones, root: Vec3): Pose {
  const observed = (joint: number): Vec3 => jointAt(clip, frame, joint);
  const { offsets, lengths } = bones;
  const joints: Vec3[] = new Array<Vec3>(JOINT_COUNT).fill(root);
  const place = (joint: number, at: Vec3): void => void (joints[joint] = at);
  const rigid = (origin: Vec3, part: readonly number[], start: Quat): Quat => {
    const rest = part.map((joint) => offsets[joint]!);
    const turn = fitRotation(
      rest,
      part.map((joint) => sub(observed(joint), origin)),
      start,
    );
    part.forEach((joint, i) => place(joint, add(origin, rotate(turn, rest[i]!))));
    return turn;
  };
  const follow = (parent: number, joint: number, fallback: Vec3): void =>
    place(joint, aim(joints[parent]!, observed(joint), lengths[joint]!, fallback));

  const pelvis = rigid(root, PELVIS_PART, pelvisFrame(clip, frame));
  const up = rotate(pelvis, [0, 1, 0]);
  follow(J.spine1, J.spine2, up);
  follow(J.spine2, J.spine3, up);
  const chest = rigid(joints[J.spine3]!, CHEST_PART, chestFrame(clip, frame));
  follow(J.neck, J.head, rotate(chest, [0, 1, 0]));
  follow(J.left_collar, J.left_shoulder, rotate(chest, [1, 0, 0]));
  follow(J.right_collar, J.right_shoulder, rotate(chest, [-1, 0, 0]));
  for (const [start, middle, end, toe] of LIMBS) {
    const fallback = rotate(toe === undefined ? chest : pelvis, direction(offsets[middle]!, [0, -1, 0]));
    place(
      middle,
      fitLimb(joints[start]!, observed(middle), observed(end), lengths[middle]!, lengths[end]!, fallback),
    );
    follow(middle, end, fallback);
    if (toe !== undefined) follow(end, toe, rotate(pelvis, [0, 0, 1]));
  }
  return { joints, pelvis, chest };
}

/** The pose on constant bones that is nearest to a frame of the clip. */
export function fitPose(clip: MotionClip, frame: number, bones: Bones): Pose {
  let root = jointAt(clip, frame, J.pelvis);
  let pose = fitFrom(clip, frame, bones, root);
  for (let pass = 0; pass < ROOT_PASSES; pass++) {
    let error = ZERO;
    pose.joints.forEach((at, joint) => (error = add(error, sub(jointAt(clip, frame, joint), at))));
    root = add(root, scale(error, 1 / JOINT_COUNT));
    pose = fitFrom(clip, frame, bones, root);
  }
  return pose;
}
