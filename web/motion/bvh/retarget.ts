import { forwardOf } from '../skeleton/heading';
import type { NodeMotion } from './sample';
import type { BvhNode } from './hierarchy';
import type { JointMap } from './joint-map';
import { conjugate, IDENTITY, multiply, type Quat, readQuat, rotate } from '../math/quat';
import { J, type JointName, SMPL22 } from '../skeleton/skeleton';
import { add, direction, distance, length, lerp, readVec, scale, sub, type Vec3, ZERO } from '../math/vec3';

/**
 * Where pelvis and spine lie between the middle of the hips (0) and the neck (1), along the back: the proportions of
 * the SMPL body. Programs put these joints anywhere; body height and the models expect them here.
 */
const TRUNK: readonly (readonly [JointName, number])[] = [
  ['pelvis', 0.18],
  ['spine1', 0.4],
  ['spine2', 0.61],
  ['spine3', 0.72],
];
/** Where a missing neck lies between the middle of the shoulders and the head, and a missing collar from neck to shoulder. */
const NECK_SHARE = 0.4;
const COLLAR_SHARE = 0.4;
/** Length from neck to head of a missing head, and of a missing foot forward and down, as parts of the trunk. */
const HEAD_LENGTH = 0.17;
const TOE_FORWARD = 0.17;
const TOE_DOWN = 0.07;
/** A foot shorter than this part of the trunk is a joint that was doubled, not a toe. */
const SHORTEST_FOOT = 0.04;

const SIDES = ['left', 'right'] as const;

/** Reads the nodes of a file as vectors, y up. */
export interface Body {
  readonly map: JointMap;
  readonly motion: NodeMotion;
  /** Turns the file's axes so that y is up. */
  readonly up: Quat;
  /** Node of each side's toe, or null where the foot is made by rule. */
  readonly toes: Readonly<Record<(typeof SIDES)[number], number | null>>;
}

/** Node that ends the foot: the toe joint, or else the end site that hangs on the ankle. */
function toeNode(nodes: readonly BvhNode[], map: JointMap, side: (typeof SIDES)[number]): number | null {
  const ankle = map.nodes.get(`${side}_ankle`)!;
  const end = nodes.findIndex(({ endSite, parent }) => endSite && parent === ankle);
  return map.nodes.get(`${side}_foot`) ?? (end < 0 ? null : end);
}

/** Nodes whose motion is read from the file. */
export function nodesOfBody(nodes: readonly BvhNode[], map: JointMap): number[] {
  const toes = SIDES.flatMap((side) => toeNode(nodes, map, side) ?? []);
  return [...new Set([...map.nodes.values(), ...map.back, ...toes])];
}

function at(body: Body, frame: number, node: number): Vec3 {
  return rotate(body.up, readVec(body.motion.position(node), frame));
}

function joint(body: Body, frame: number, name: JointName): Vec3 {
  return at(body, frame, body.map.nodes.get(name)!);
}

/** Points up the back: middle of the hips, the file's spine, neck. */
function backLine(body: Body, frame: number, neck: Vec3): Vec3[] {
  const hips = lerp(joint(body, frame, 'left_hip'), joint(body, frame, 'right_hip'), 0.5);
  return [hips, ...body.map.back.map((node) => at(body, frame, node)), neck];
}

/** The point at a share of a line's length. */
function along(line: readonly Vec3[], share: number): Vec3 {
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
  const shoulders = lerp(joint(body, frame, 'left_shoulder'), joint(body, frame, 'right_shoulder'), 0.5);
  if (!body.map.nodes.has('neck')) {
    const head = joint(body, frame, 'head');
    return { neck: lerp(shoulders, head, NECK_SHARE), head };
  }
  const neck = joint(body, frame, 'neck');
  if (body.map.nodes.has('head')) return { neck, head: joint(body, frame, 'head') };
  const [hips] = backLine(body, frame, neck) as [Vec3];
  const trunk = sub(neck, hips);
  return { neck, head: add(neck, scale(trunk, HEAD_LENGTH)) };
}

/** Direction in which the hips point, level with the floor. */
function hipForward(body: Body, frame: number): Vec3 {
  return forwardOf(sub(joint(body, frame, 'left_hip'), joint(body, frame, 'right_hip')));
}

/** Vectors of a frame that the reader learns unit and axes from, in the file's own unit. */
export function measure(body: Body, frame: number): { size: number; upright: Vec3; footAhead: number } {
  const { neck, head } = neckAndHead(body, frame);
  const [hips] = backLine(body, frame, neck) as [Vec3];
  const legs = SIDES.map((side) => {
    const knee = joint(body, frame, `${side}_knee`);
    return (
      distance(joint(body, frame, `${side}_hip`), knee) + distance(knee, joint(body, frame, `${side}_ankle`))
    );
  });
  const ankles = SIDES.map((side) => joint(body, frame, `${side}_ankle`)) as [Vec3, Vec3];
  const ahead = SIDES.map((side, i) => {
    const toe = body.toes[side];
    const foot = toe === null ? ZERO : direction(sub(at(body, frame, toe), ankles[i]!), ZERO);
    const front = hipForward(body, frame);
    return foot[0] * front[0] + foot[2] * front[2];
  });
  return {
    size: (legs[0]! + legs[1]!) / 2 + distance(hips, neck) + distance(neck, head),
    upright: sub(head, lerp(ankles[0], ankles[1], 0.5)),
    footAhead: (ahead[0]! + ahead[1]!) / 2,
  };
}

/** Chooses toes that a foot can have: a node that lies on the ankle is none. */
export function withToes(nodes: readonly BvhNode[], map: JointMap, motion: NodeMotion): Body {
  const bare: Body = { map, motion, up: IDENTITY, toes: { left: null, right: null } };
  const { size } = measure(bare, 0);
  const [left, right] = SIDES.map((side) => {
    const toe = toeNode(nodes, map, side);
    const foot = toe === null ? 0 : distance(at(bare, 0, toe), joint(bare, 0, `${side}_ankle`));
    return foot > SHORTEST_FOOT * size ? toe : null;
  }) as [number | null, number | null];
  return { ...bare, toes: { left, right } };
}

/**
 * Where the toe lies as seen from the ankle, for a file without toes: ahead and below on the average over the clip,
 * so that the made foot turns with the ankle. In the ankle's own axes and the file's unit.
 */
function madeToe(body: Body, side: (typeof SIDES)[number], trunk: number): Vec3 {
  const turns = body.motion.rotation(body.map.nodes.get(`${side}_ankle`)!);
  let sum = ZERO;
  for (let frame = 0; frame < body.motion.frames; frame++) {
    const front = add(scale(hipForward(body, frame), TOE_FORWARD), [0, -TOE_DOWN, 0]);
    sum = add(sum, rotate(conjugate(multiply(body.up, readQuat(turns, frame))), front));
  }
  return scale(direction(sum, [0, 0, 1]), trunk * Math.hypot(TOE_FORWARD, TOE_DOWN));
}

/**
 * All 22 joints over time, in the file's unit, y up: read where the file has them, else made by rule.
 *
 * @returns frames x 22 x 3, and the names of the joints that were made
 */
export function assemble(body: Body): { positions: Float64Array; filled: JointName[] } {
  const { map, motion, toes } = body;
  const made = new Map<string, Vec3>();
  const trunk = length(sub(neckAndHead(body, 0).neck, backLine(body, 0, ZERO)[0]!));
  for (const side of SIDES) if (toes[side] === null) made.set(side, madeToe(body, side, trunk));

  const positions = new Float64Array(motion.frames * SMPL22.length * 3);
  for (let frame = 0; frame < motion.frames; frame++) {
    const put = (name: JointName, place: Vec3): void =>
      positions.set(place, (frame * SMPL22.length + J[name]) * 3);
    for (const [name, node] of map.nodes) put(name, at(body, frame, node));
    const { neck, head } = neckAndHead(body, frame);
    put('neck', neck);
    put('head', head);
    if (!map.ownTrunk) {
      const line = backLine(body, frame, neck);
      for (const [name, share] of TRUNK) put(name, along(line, share));
    }
    for (const side of SIDES) {
      const collar = `${side}_collar` as const;
      if (!map.nodes.has(collar))
        put(collar, lerp(neck, joint(body, frame, `${side}_shoulder`), COLLAR_SHARE));
      const ankle = map.nodes.get(`${side}_ankle`)!;
      const toe = toes[side];
      const turn = multiply(body.up, readQuat(motion.rotation(ankle), frame));
      const foot =
        toe === null ? add(at(body, frame, ankle), rotate(turn, made.get(side)!)) : at(body, frame, toe);
      put(`${side}_foot`, foot);
    }
  }
  const read = new Set<JointName>(map.nodes.keys());
  for (const side of SIDES) {
    if (toes[side] === null) read.delete(`${side}_foot`);
    else read.add(`${side}_foot`);
  }
  return { positions, filled: SMPL22.filter((name) => !read.has(name)) };
}
