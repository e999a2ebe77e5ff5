import { sampleNodes, type NodeMotion } from './sample';
import type { BvhFile } from './text';
import type { JointMap } from './joint-map';
import { conjugate, readQuat, rotate } from '../math/quat';
import type { JointName } from '../skeleton/skeleton';
import { add, direction, distance, dot, lerp, readVec, scale, sub, type Vec3, ZERO } from '../math/vec3';

/** Frames of the file after the first one that it is compared with, and the fewest that can tell anything. */
const AFTER = 32;
const FEWEST_AFTER = 12;
/** A jump is this many times more sudden than anything in the frames after it; dances reach 2, their faults 5. */
const SUDDEN = 4;
/** The least jump, root mean square over the joints, as part of leg, trunk and neck: 6 cm. */
const LEAST_JUMP = 0.05;
/** How far a bone may be from where a T-pose or the file's rest pose has it, as cosines of 20 and 12 degrees. */
const AS_T_POSE = Math.cos((20 * Math.PI) / 180);
const AS_REST = Math.cos((12 * Math.PI) / 180);
/**
 * A solver that starts from the rest pose needs some frames until it has found the dance. These are hurried, as parts
 * of the body per frame, and many times faster than what follows.
 */
const LONGEST_LANDING = 8;
const HURRIED = 0.03;
const SLOWER_AFTER = 4;

const SIDES = ['left', 'right'] as const;
const BONES = SIDES.flatMap((side) => [
  [`${side}_hip`, `${side}_knee`],
  [`${side}_knee`, `${side}_ankle`],
  [`${side}_shoulder`, `${side}_elbow`],
  [`${side}_elbow`, `${side}_wrist`],
]) as readonly (readonly [JointName, JointName])[];

/**
 * How many frames at the beginning of a file are no dance: the rest pose that many programs write before it, and the
 * frames in which the body is still on its way out of it. 0 unless that is certain: the first pose must be a T-pose or
 * the file's own rest pose, and the way to the second one a jump that no body makes. The rule is that of
 * training/data/bvh/rest_pose.py.
 */
export function restFrames(file: BvhFile, map: JointMap): number {
  const first = file.frameLines.slice(0, AFTER + 2);
  if (first.length < FEWEST_AFTER + 2) return 0;
  const nodes = [...map.nodes.values()];
  const motion = sampleNodes({ ...file, frameLines: first }, nodes, 1, 1);
  const place = (node: number, frame: number): Vec3 => readVec(motion.position(node), frame);
  const joint = (name: JointName): Vec3 => place(map.nodes.get(name)!, 0);
  if (!isTPose(joint, topOf(map)) && !isRestPose(file, map, motion)) return 0;

  const frames = [...first.keys()];
  const mean = (way: (node: number) => number): number =>
    Math.sqrt(nodes.reduce((sum, node) => sum + way(node) ** 2, 0) / nodes.length);
  const steps = frames
    .slice(1)
    .map((frame) => mean((node) => distance(place(node, frame), place(node, frame - 1))));
  /** How far each frame is from where its two neighbours let one expect it. */
  const shocks = frames
    .slice(2)
    .map((frame) =>
      mean((node) => distance(lerp(place(node, frame), place(node, frame - 2), 0.5), place(node, frame - 1))),
    );
  const size = bodySize(joint, topOf(map));
  if (steps[0]! < LEAST_JUMP * size || shocks[0]! < SUDDEN * Math.max(...shocks.slice(1))) return 0;
  const calm = SLOWER_AFTER * Math.max(...steps.slice(1 + LONGEST_LANDING));
  return steps.findIndex(
    (step, frame) => frame > LONGEST_LANDING || (frame > 0 && (step < HURRIED * size || step < calm)),
  );
}

type At = (joint: JointName) => Vec3;

/** The upper end of the back: the neck, or the head where the file has no neck. */
function topOf(map: JointMap): JointName {
  return map.nodes.has('neck') ? 'neck' : 'head';
}

const middleOfHips = (at: At): Vec3 => lerp(at('left_hip'), at('right_hip'), 0.5);

/** Leg and trunk in the file's unit. */
function bodySize(at: At, top: JointName): number {
  const legs = SIDES.map(
    (side) =>
      distance(at(`${side}_hip`), at(`${side}_knee`)) + distance(at(`${side}_knee`), at(`${side}_ankle`)),
  );
  return (legs[0]! + legs[1]!) / 2 + distance(middleOfHips(at), at(top));
}

/** Arms straight out to the sides and legs straight down, whatever way the body is turned. */
function isTPose(at: At, top: JointName): boolean {
  const left = direction(sub(at('left_hip'), at('right_hip')), ZERO);
  const up = direction(sub(at(top), middleOfHips(at)), ZERO);
  return BONES.every(([from, to]) => {
    const bone = direction(sub(at(to), at(from)), ZERO);
    const leg = /hip|knee/.test(from);
    const meant = leg ? scale(up, -1) : scale(left, from.startsWith('left') ? 1 : -1);
    return dot(bone, meant) > AS_T_POSE;
  });
}

/** Every limb as the skeleton of the file has it before any joint is turned, whatever way the hips are turned. */
function isRestPose(file: BvhFile, map: JointMap, motion: NodeMotion): boolean {
  const rest: Vec3[] = [];
  for (const { parent, offset } of file.nodes)
    rest.push(parent < 0 ? [...offset] : add(rest[parent]!, offset));
  const hips = file.nodes[map.nodes.get('left_hip')!]!.parent;
  if (hips < 0) return false;
  const home = conjugate(readQuat(motion.rotation(hips), 0));
  return BONES.every((ends) => {
    const [from, to] = ends.map((name) => map.nodes.get(name)!) as [number, number];
    const seen = rotate(home, sub(readVec(motion.position(to), 0), readVec(motion.position(from), 0)));
    return dot(direction(seen, ZERO), direction(sub(rest[to]!, rest[from]!), ZERO)) > AS_REST;
  });
}
