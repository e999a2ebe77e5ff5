import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { forwardKinematics } from '../skeleton/kinematics';
import { type Bones, bonesOf, fitPoses, type Poses } from './pose-fit';
import {
  aboutAxis,
  between,
  conjugate,
  fromAxes,
  multiply,
  negate,
  type Quat,
  quatDot,
  readQuat,
  rotate,
  slerp,
  writeQuat,
} from '../math/quat';
import { rotateRow, rowDistance } from '../math/rows';
import { restOffsets } from './rest-pose';
import { ARMS, LEGS, type LimbJoints } from '../skeleton/limbs';
import { J, JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import { steadyTrunk, trunkRotations } from './trunk';
import { smoothHinges } from './twist';
import { add, cross, direction, dot, readVec, scale, sub, type Vec3, writeVec } from '../math/vec3';

/** A limb whose upper bone gets its twist from the hinge at its middle joint. */
interface Limb extends LimbJoints {
  /** The part of the body that carries it. */
  readonly part: 'pelvis' | 'chest';
  readonly toe: number | null;
}

const LIMBS: readonly Limb[] = [
  ...LEGS.map((leg) => ({ ...leg, part: 'pelvis' as const })),
  ...ARMS.map((arm) => ({ ...arm, part: 'chest' as const, toe: null })),
];

/** Weight of the foot's direction in the leg's twist, where a knee bent at a right angle has 1. */
const FOOT_WEIGHT = 0.3;

/** Hinge axis of a limb in world axes, frames x 3. */
function hingesOf(limb: Limb, poses: Poses, bones: Bones): Float64Array {
  const rest = readVec(bones.directions, limb.middle);
  const part = poses[limb.part];
  const frames = part.length / 4;
  const directions = new Float64Array(3 * frames);
  const observed = new Float64Array(3 * frames);
  const priors = new Float64Array(3 * frames);
  for (let frame = 0; frame < frames; frame++) {
    const inverse = conjugate(readQuat(part, frame));
    const at = (joint: number): Vec3 => readVec(poses.joints, frame * JOINT_COUNT + joint);
    const bone = (from: number, to: number): Vec3 => direction(rotate(inverse, sub(at(to), at(from))), rest);
    const upper = bone(limb.start, limb.middle);
    const lower = bone(limb.middle, limb.end);
    let hinge = cross(upper, lower);
    if (limb.toe !== null) {
      hinge = add(hinge, scale(cross(bone(limb.end, limb.toe), lower), FOOT_WEIGHT));
    }
    writeVec(directions, frame, upper);
    writeVec(observed, frame, hinge);
    writeVec(priors, frame, rotate(between(rest, upper), limb.hinge));
  }
  const hinges = smoothHinges(directions, observed, priors);
  for (let frame = 0; frame < frames; frame++) rotateRow(hinges, frame, part, frame, hinges, frame);
  return hinges;
}

/**
 * How much of the turn from pelvis to chest each of the two joints between them takes: a third up to a right angle, and
 * none half a turn away. A chest that goes on past that is turned the other way round against the pelvis; joints with a
 * third of it would jump there, and between two frames the chest would face the wrong way.
 */
function spineShare(pelvis: Quat, chest: Quat): number {
  const angle = 2 * Math.acos(Math.min(1, Math.abs(quatDot(pelvis, chest))));
  return Math.min(1, 2 - (2 * angle) / Math.PI) / 3;
}

/** The angle about a unit axis that turns `from` the nearest to `to`, both unit vectors, radians. */
function angleAbout(axis: Vec3, from: Vec3, to: Vec3): number {
  return Math.atan2(dot(cross(from, to), axis), dot(from, to) - dot(from, axis) * dot(to, axis));
}

/** Cosine and sine of the smallest angle between upper arm and forearm: 25 degrees, the least of the captured dancers. */
const FOLDED = { cosine: Math.cos((25 * Math.PI) / 180), sine: Math.sin((25 * Math.PI) / 180) };

/** The direction of a forearm; one that is folded farther than elbows fold is opened in the plane across the hinge. */
function unfolded(lower: Vec3, upper: Vec3, hinge: Vec3): Vec3 {
  const side = cross(hinge, upper);
  const [onSide, onHinge] = [dot(lower, side), dot(lower, hinge)];
  const opened = Math.sqrt(Math.max(0, FOLDED.sine ** 2 - onHinge ** 2));
  if (dot(lower, upper) > -FOLDED.cosine || Math.abs(onSide) >= opened) return lower;
  return add(add(scale(upper, -FOLDED.cosine), scale(side, opened)), scale(hinge, onHinge));
}

/** World rotation of every joint in one frame, given the hinge axes of the four limbs. */
function worldRotations(poses: Poses, frame: number, bones: Bones, hinges: readonly Vec3[]): Quat[] {
  const turns: Quat[] = [];
  const at = (joint: number): Vec3 => readVec(poses.joints, frame * JOINT_COUNT + joint);
  const [pelvis, chest] = [readQuat(poses.pelvis, frame), readQuat(poses.chest, frame)];
  const aimed = (base: Quat, from: number, to: number): Quat => {
    const rest = rotate(base, readVec(bones.directions, to));
    return multiply(between(rest, direction(sub(at(to), at(from)), rest)), base);
  };
  turns[J.pelvis] = pelvis;
  const share = spineShare(pelvis, chest);
  turns[J.spine1] = aimed(slerp(pelvis, chest, share), J.spine1, J.spine2);
  turns[J.spine2] = aimed(slerp(pelvis, chest, 2 * share), J.spine2, J.spine3);
  turns[J.spine3] = chest;
  const neck = aimed(chest, J.neck, J.head);
  turns[J.neck] = neck;
  // No joint position shows the head's own rotation: it is that of the neck.
  turns[J.head] = neck;
  turns[J.left_collar] = aimed(chest, J.left_collar, J.left_shoulder);
  turns[J.right_collar] = aimed(chest, J.right_collar, J.right_shoulder);
  LIMBS.forEach(({ start, middle, end, toe, hinge }, i) => {
    const rest = readVec(bones.directions, middle);
    const bone = direction(sub(at(middle), at(start)), rest);
    const upper = multiply(fromAxes(hinges[i]!, bone), conjugate(fromAxes(hinge, rest)));
    turns[start] = upper;
    // About the hinge first: a limb that folds onto itself has no shortest rotation, and a forearm would flip there.
    const forward = rotate(upper, readVec(bones.directions, end));
    const seen = direction(sub(at(end), at(middle)), forward);
    const towards = toe === null ? unfolded(seen, bone, hinges[i]!) : seen;
    const bent = multiply(aboutAxis(hinges[i]!, angleAbout(hinges[i]!, forward, towards)), upper);
    const lower = multiply(between(rotate(bent, readVec(bones.directions, end)), towards), bent);
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
 * @param known offsets of the skeleton, 22 x 3 metres, where they are known already
 */
export function solve(clip: MotionClip, known?: Float32Array): SolvedMotion {
  const { frames, fps } = clip;
  const observed = new Float64Array(clip.positions);
  const trunk = trunkRotations(observed);
  const offsets = known ?? restOffsets(observed, trunk);
  const bones = bonesOf(offsets);
  const poses = fitPoses(observed, bones, steadyTrunk(trunk, observed, offsets, fps));
  const hinges = LIMBS.map((limb) => hingesOf(limb, poses, bones));

  const root = new Float32Array(frames * 3);
  const rotations = new Float32Array(frames * JOINT_COUNT * 4);
  const previous: Quat[] = [];
  for (let frame = 0; frame < frames; frame++) {
    writeVec(root, frame, readVec(poses.joints, frame * JOINT_COUNT + J.pelvis));
    const turns = worldRotations(
      poses,
      frame,
      bones,
      hinges.map((axes) => readVec(axes, frame)),
    );
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const parent = PARENTS[joint]!;
      let local = parent < 0 ? turns[joint]! : multiply(conjugate(turns[parent]!), turns[joint]!);
      const before = previous[joint];
      if (before !== undefined && quatDot(before, local) < 0) local = negate(local);
      previous[joint] = local;
      writeQuat(rotations, frame * JOINT_COUNT + joint, local);
    }
  }
  const positions = forwardKinematics(offsets, root, rotations);
  let error = 0;
  for (let i = 0; i < frames * JOINT_COUNT; i++) error += rowDistance(positions, i, observed, i);
  return { fps, frames, offsets, root, rotations, positions, fitError: error / (frames * JOINT_COUNT) };
}
