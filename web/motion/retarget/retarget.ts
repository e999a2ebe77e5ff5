import { forwardOf } from '../skeleton/heading';
import type { NodeMotion } from './sample';
import type { SourceJoint } from './source';
import type { JointMap } from './joint-map';
import { conjugate, IDENTITY, multiply, type Quat, readQuat, rotate } from '../math/quat';
import { J, type JointName, type Side, SIDES, SMPL22 } from '../skeleton/skeleton';
import { add, direction, distance, length, lerp, readVec, scale, sub, type Vec3, ZERO } from '../math/vec3';

/**
 * Place of pelvis and spine joints along the spine, from the middle of the hips (0) to the neck (1): the proportions of
 * the SMPL body, which body height and the models expect. Other conventions place these joints differently.
 */
const TRUNK_SHARES: readonly (readonly [JointName, number])[] = [
  ['pelvis', 0.18],
  ['spine1', 0.4],
  ['spine2', 0.61],
  ['spine3', 0.72],
];
/** Place of a missing neck from the middle of the shoulders to the head, and of a missing collar from neck to shoulder. */
const NECK_SHARE = 0.4;
const COLLAR_SHARE = 0.4;
/** Distance of a missing head from the neck, and of a missing toe forward and down from the ankle, as shares of the trunk. */
const HEAD_LENGTH = 0.17;
const TOE_FORWARD = 0.17;
const TOE_DOWN = 0.07;
/** A toe nearer to the ankle than this share of the body's size is a duplicate of the ankle. */
const MIN_FOOT_LENGTH = 0.04;
/** Largest difference in a quaternion of rotations that are the same. */
const SAME_TURN = 1e-6;

/** The body in a file: its joint map, the motion of its nodes and the rotation to y up. */
export interface Body {
  readonly map: JointMap;
  readonly motion: NodeMotion;
  /** Rotation of the file's axes that makes y up. */
  readonly up: Quat;
  /** Node of each side's toe, or null where it is estimated. */
  readonly toes: Readonly<Record<Side, number | null>>;
}

/**
 * The toe joint; else what is below the ankle: a joint that is called a toe, the only joint, or the end site. Null where
 * the file has none of them. Where joints were chosen by hand, no other joint is taken.
 */
function toeNode(nodes: readonly SourceJoint[], map: JointMap, side: Side): number | null {
  const named = map.nodes.get(`${side}_foot`);
  if (named !== undefined) return named;
  const ankle = map.nodes.get(`${side}_ankle`)!;
  // A heel points backwards.
  const below = [...nodes.keys()].filter(
    (node) => nodes[node]!.parent === ankle && !/heel/i.test(nodes[node]!.name),
  );
  const end = below.find((node) => nodes[node]!.endSite) ?? null;
  if (map.by === 'hand') return end;
  return below.find((node) => /toe/i.test(nodes[node]!.name)) ?? (below.length === 1 ? below[0]! : end);
}

/** Nodes whose motion is read from the file. */
export function nodesOfBody(nodes: readonly SourceJoint[], map: JointMap): number[] {
  const toes = SIDES.flatMap((side) => toeNode(nodes, map, side) ?? []);
  return [...new Set([...map.nodes.values(), ...map.spine, ...toes])];
}

/** Position of a node in a frame, y up. */
function nodeAt(body: Body, frame: number, node: number): Vec3 {
  return rotate(body.up, readVec(body.motion.position(node), frame));
}

/** Position of a joint that the file has, y up. */
function jointAt(body: Body, frame: number, name: JointName): Vec3 {
  return nodeAt(body, frame, body.map.nodes.get(name)!);
}

/** Points along the spine: middle of the hips, the file's spine joints, neck. */
function spineLine(body: Body, frame: number, neck: Vec3): Vec3[] {
  const hips = lerp(jointAt(body, frame, 'left_hip'), jointAt(body, frame, 'right_hip'), 0.5);
  return [hips, ...body.map.spine.map((node) => nodeAt(body, frame, node)), neck];
}

/** The point at a share of a polyline's length. */
function pointAlong(line: readonly Vec3[], share: number): Vec3 {
  const steps = line.slice(1).map((point, i) => distance(point, line[i]!));
  let left = share * steps.reduce((sum, step) => sum + step, 0);
  for (let i = 0; i < steps.length; i++) {
    if (left <= steps[i]!) return lerp(line[i]!, line[i + 1]!, steps[i]! > 0 ? left / steps[i]! : 0);
    left -= steps[i]!;
  }
  return line.at(-1)!;
}

/** Neck and head of a frame; one of them may be missing in the file. */
function neckAndHead(body: Body, frame: number): { neck: Vec3; head: Vec3 } {
  const shoulders = lerp(jointAt(body, frame, 'left_shoulder'), jointAt(body, frame, 'right_shoulder'), 0.5);
  if (!body.map.nodes.has('neck')) {
    const head = jointAt(body, frame, 'head');
    return { neck: lerp(shoulders, head, NECK_SHARE), head };
  }
  const neck = jointAt(body, frame, 'neck');
  if (body.map.nodes.has('head')) return { neck, head: jointAt(body, frame, 'head') };
  const [hips] = spineLine(body, frame, neck) as [Vec3];
  const trunk = sub(neck, hips);
  return { neck, head: add(neck, scale(trunk, HEAD_LENGTH)) };
}

/** Heading of the hips: unit vector level with the floor. */
function hipForward(body: Body, frame: number): Vec3 {
  return forwardOf(sub(jointAt(body, frame, 'left_hip'), jointAt(body, frame, 'right_hip')));
}

/**
 * Measures of a frame from which unit and axes are inferred, in the file's own unit: leg plus trunk plus neck, the vector
 * from the feet to the head, and how far the feet point ahead (1) or backwards (-1).
 */
export function measureBody(body: Body, frame: number): { size: number; upright: Vec3; footAhead: number } {
  const { neck, head } = neckAndHead(body, frame);
  const [hips] = spineLine(body, frame, neck) as [Vec3];
  const legs = SIDES.map((side) => {
    const knee = jointAt(body, frame, `${side}_knee`);
    return (
      distance(jointAt(body, frame, `${side}_hip`), knee) +
      distance(knee, jointAt(body, frame, `${side}_ankle`))
    );
  });
  const ankles = SIDES.map((side) => jointAt(body, frame, `${side}_ankle`)) as [Vec3, Vec3];
  const ahead = SIDES.map((side, i) => {
    const toe = body.toes[side];
    const foot = toe === null ? ZERO : direction(sub(nodeAt(body, frame, toe), ankles[i]!), ZERO);
    const front = hipForward(body, frame);
    return foot[0] * front[0] + foot[2] * front[2];
  });
  return {
    size: (legs[0]! + legs[1]!) / 2 + distance(hips, neck) + distance(neck, head),
    upright: sub(head, lerp(ankles[0], ankles[1], 0.5)),
    footAhead: (ahead[0]! + ahead[1]!) / 2,
  };
}

/** The body with its toes; a node that lies on the ankle is not taken for one. */
export function withToes(nodes: readonly SourceJoint[], map: JointMap, motion: NodeMotion): Body {
  const bare: Body = { map, motion, up: IDENTITY, toes: { left: null, right: null } };
  const { size } = measureBody(bare, 0);
  const [left, right] = SIDES.map((side) => {
    const toe = toeNode(nodes, map, side);
    const foot = toe === null ? 0 : distance(nodeAt(bare, 0, toe), jointAt(bare, 0, `${side}_ankle`));
    return foot > MIN_FOOT_LENGTH * size ? toe : null;
  }) as [number | null, number | null];
  return { ...bare, toes: { left, right } };
}

/**
 * The step from the ankle to an estimated toe in a frame, y up, in the file's unit: ahead and below. On average over the
 * clip where the ankle turns, so that the foot turns with it; by the hips of each frame where it never does, as in files
 * of positions.
 */
function estimatedToe(body: Body, side: Side, trunk: number): (frame: number) => Vec3 {
  const turns = body.motion.rotation(body.map.nodes.get(`${side}_ankle`)!);
  const turn = (frame: number): Quat => multiply(body.up, readQuat(turns, frame));
  const ahead = (frame: number): Vec3 => add(scale(hipForward(body, frame), TOE_FORWARD), [0, -TOE_DOWN, 0]);
  if (turns.every((value, i) => Math.abs(value - turns[i % 4]!) < SAME_TURN))
    return (frame) => scale(ahead(frame), trunk);
  let sum = ZERO;
  for (let frame = 0; frame < body.motion.frames; frame++)
    sum = add(sum, rotate(conjugate(turn(frame)), ahead(frame)));
  const step = scale(direction(sum, [0, 0, 1]), trunk * Math.hypot(TOE_FORWARD, TOE_DOWN));
  return (frame) => rotate(turn(frame), step);
}

/** Place of a side's toe in a frame, y up: that of the file, or an estimate. */
function toePlace(body: Body, side: Side, trunk: number): (frame: number) => Vec3 {
  const toe = body.toes[side];
  if (toe !== null) return (frame) => nodeAt(body, frame, toe);
  const step = estimatedToe(body, side, trunk);
  return (frame) => add(jointAt(body, frame, `${side}_ankle`), step(frame));
}

/**
 * Retargets the body of a file to the SMPL skeleton: its 22 joints over time, in the file's unit, y up; those that the
 * file lacks are estimated.
 *
 * @returns frames x 22 x 3, and the names of the estimated joints
 */
export function retarget(body: Body): { positions: Float64Array; estimated: JointName[] } {
  const { map, motion } = body;
  const trunk = length(sub(neckAndHead(body, 0).neck, spineLine(body, 0, ZERO)[0]!));
  const toes = { left: toePlace(body, 'left', trunk), right: toePlace(body, 'right', trunk) };

  const positions = new Float64Array(motion.frames * SMPL22.length * 3);
  for (let frame = 0; frame < motion.frames; frame++) {
    const put = (name: JointName, place: Vec3): void =>
      positions.set(place, (frame * SMPL22.length + J[name]) * 3);
    for (const [name, node] of map.nodes) put(name, nodeAt(body, frame, node));
    const { neck, head } = neckAndHead(body, frame);
    put('neck', neck);
    put('head', head);
    if (!map.hasSmplTrunk) {
      const line = spineLine(body, frame, neck);
      for (const [name, share] of TRUNK_SHARES) put(name, pointAlong(line, share));
    }
    for (const side of SIDES) {
      const collar = `${side}_collar` as const;
      if (!map.nodes.has(collar))
        put(collar, lerp(neck, jointAt(body, frame, `${side}_shoulder`), COLLAR_SHARE));
      put(`${side}_foot`, toes[side](frame));
    }
  }
  return { positions, estimated: estimatedJoints(body) };
}

/** The joints that the file lacks. */
function estimatedJoints({ map, toes }: Body): JointName[] {
  const read = new Set<JointName>(map.nodes.keys());
  for (const side of SIDES) {
    if (toes[side] === null) read.delete(`${side}_foot`);
    else read.add(`${side}_foot`);
  }
  return SMPL22.filter((name) => !read.has(name));
}
