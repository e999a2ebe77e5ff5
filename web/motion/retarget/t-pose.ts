import { sampleNodes, type NodeMotion, worldPose } from './sample';
import type { MotionSource } from './source';
import type { JointMap } from './joint-map';
import { conjugate, type Quat, readQuat, rotate } from '../math/quat';
import { type JointName, SIDES } from '../skeleton/skeleton';
import { direction, distance, dot, lerp, readVec, scale, sub, type Vec3, ZERO } from '../math/vec3';

/** Frames after the first one with which it is compared, at most and at least. */
const COMPARED_FRAMES = 32;
const MIN_COMPARED_FRAMES = 12;
/** A jump's acceleration is this many times the largest one after it; in dances the ratio reaches 2, at faults 5. */
const ACCELERATION_RATIO = 4;
/** Least length of a jump, root mean square over the joints, as a share of leg, trunk and neck: 6 cm. */
const MIN_JUMP = 0.05;
/** Largest angle of a bone to that of a T-pose and of the file's rest pose, 20 and 12 degrees, as cosines. */
const T_POSE_COSINE = Math.cos((20 * Math.PI) / 180);
const REST_POSE_COSINE = Math.cos((12 * Math.PI) / 180);
/**
 * Transition from the rest pose to the dance, as solvers write it that start from the rest pose: at most this many
 * frames, at least this fast (shares of the body per frame), and this many times faster than what follows.
 */
const MAX_TRANSITION_FRAMES = 8;
const MIN_TRANSITION_SPEED = 0.03;
const TRANSITION_SPEED_RATIO = 4;

const BONES = SIDES.flatMap((side) => [
  [`${side}_hip`, `${side}_knee`],
  [`${side}_knee`, `${side}_ankle`],
  [`${side}_shoulder`, `${side}_elbow`],
  [`${side}_elbow`, `${side}_wrist`],
]) as readonly (readonly [JointName, JointName])[];

/**
 * Number of frames at the beginning of a file that are no dance: the rest pose that many programs write before it, and
 * the transition out of it. 0 unless that is certain: the first pose must be a T-pose or the file's own rest pose, and
 * the step to the second one faster than a body can move. The rule is that of training/data/bvh/rest_pose.py.
 */
export function restFrames(source: MotionSource, map: JointMap): number {
  const first = Math.min(source.frames, COMPARED_FRAMES + 2);
  if (first < MIN_COMPARED_FRAMES + 2) return 0;
  const nodes = [...map.nodes.values()];
  const motion = sampleNodes({ ...source, frames: first }, nodes, 1, 1);
  const place = (node: number, frame: number): Vec3 => readVec(motion.position(node), frame);
  const joint = (name: JointName): Vec3 => place(map.nodes.get(name)!, 0);
  if (!isTPose(joint, topOf(map)) && !isRestPose(source, map, motion)) return 0;

  const frames = [...Array(first).keys()];
  const rootMeanSquare = (value: (node: number) => number): number =>
    Math.sqrt(nodes.reduce((sum, node) => sum + value(node) ** 2, 0) / nodes.length);
  const steps = frames
    .slice(1)
    .map((frame) => rootMeanSquare((node) => distance(place(node, frame), place(node, frame - 1))));
  /** Distance of each frame from the middle of its two neighbours: half the acceleration. */
  const accelerations = frames
    .slice(2)
    .map((frame) =>
      rootMeanSquare((node) =>
        distance(lerp(place(node, frame), place(node, frame - 2), 0.5), place(node, frame - 1)),
      ),
    );
  const size = bodySize(joint, topOf(map));
  if (
    steps[0]! < MIN_JUMP * size ||
    accelerations[0]! < ACCELERATION_RATIO * Math.max(...accelerations.slice(1))
  )
    return 0;
  const dancing = TRANSITION_SPEED_RATIO * Math.max(...steps.slice(1 + MAX_TRANSITION_FRAMES));
  return steps.findIndex(
    (step, frame) =>
      frame > MAX_TRANSITION_FRAMES || (frame > 0 && (step < MIN_TRANSITION_SPEED * size || step < dancing)),
  );
}

/** Position of a joint in the first frame. */
type At = (joint: JointName) => Vec3;

/** The upper end of the back: the neck, or the head where the file has no neck. */
function topOf(map: JointMap): JointName {
  return map.nodes.has('neck') ? 'neck' : 'head';
}

/** The middle of the hips. */
const middleOfHips = (at: At): Vec3 => lerp(at('left_hip'), at('right_hip'), 0.5);

/** Leg and trunk in the file's unit. */
function bodySize(at: At, top: JointName): number {
  const legs = SIDES.map(
    (side) =>
      distance(at(`${side}_hip`), at(`${side}_knee`)) + distance(at(`${side}_knee`), at(`${side}_ankle`)),
  );
  return (legs[0]! + legs[1]!) / 2 + distance(middleOfHips(at), at(top));
}

/** Whether the arms are straight out to the sides and the legs straight down, for any rotation of the body. */
function isTPose(at: At, top: JointName): boolean {
  const left = direction(sub(at('left_hip'), at('right_hip')), ZERO);
  const up = direction(sub(at(top), middleOfHips(at)), ZERO);
  return BONES.every(([from, to]) => {
    const bone = direction(sub(at(to), at(from)), ZERO);
    const leg = /hip|knee/.test(from);
    const expected = leg ? scale(up, -1) : scale(left, from.startsWith('left') ? 1 : -1);
    return dot(bone, expected) > T_POSE_COSINE;
  });
}

/** Whether every limb is as in the file's skeleton without any joint rotation, for any rotation of the hips. */
function isRestPose({ joints, rest }: MotionSource, map: JointMap, motion: NodeMotion): boolean {
  const hips = joints[map.nodes.get('left_hip')!]!.parent;
  if (hips < 0) return false;
  const { places, turns } = worldPose(joints, rest, 0);
  const [now, then] = [readQuat(motion.rotation(hips), 0), turns[hips]!].map(conjugate) as [Quat, Quat];
  return BONES.every((ends) => {
    const [from, to] = ends.map((name) => map.nodes.get(name)!) as [number, number];
    const bone = rotate(now, sub(readVec(motion.position(to), 0), readVec(motion.position(from), 0)));
    const resting = rotate(then, sub(places[to]!, places[from]!));
    return dot(direction(bone, ZERO), direction(resting, ZERO)) > REST_POSE_COSINE;
  });
}
