import { damagedGltf, type Gltf } from './container';
import { Matrix4, Quaternion, Vector3 } from 'three';
import { conjugate, multiply, normaliseQuat, type Quat, rotate, writeQuat } from '../../math/quat';
import { sub, type Vec3, writeVec, ZERO } from '../../math/vec3';
import type { LocalPoses, SourceJoint } from '../../retarget/source';
import { type Tracks, valueAt } from './animation';

/** Largest number of nodes. */
const MAX_NODES = 5000;

/** Translation, rotation and scale of a node from its parent. */
interface Transform {
  readonly place: Vec3;
  readonly turn: Quat;
  readonly size: Vec3;
}

/** The nodes of a file that may be joints, in an order in which parents come first. */
export interface Skeleton {
  readonly joints: readonly SourceJoint[];
  /** Number in the file of each joint. */
  readonly nodes: readonly number[];
  readonly rest: readonly Transform[];
}

function transformOf(node: Gltf['nodes'][number]): Transform {
  if (node.matrix) {
    const [place, turn, size] = [new Vector3(), new Quaternion(), new Vector3()];
    new Matrix4().fromArray(node.matrix).decompose(place, turn, size);
    return {
      place: place.toArray(),
      turn: normaliseQuat(turn.toArray()),
      size: size.toArray(),
    };
  }
  const { translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] } = node;
  return {
    place: translation as unknown as Vec3,
    turn: normaliseQuat(rotation as unknown as Quat),
    size: scale as unknown as Vec3,
  };
}

/**
 * Beside the joints of skins, meshes on which no joint hangs are left out: one may have the name of a joint.
 *
 * @param names names of nodes in place of their own, as a VRM gives them
 * @throws {AppError} `unreadable-file`
 */
export function skeletonOf({ nodes, skins }: Gltf, names: ReadonlyMap<number, string>): Skeleton {
  if (nodes.length > MAX_NODES)
    throw damagedGltf(`it has ${nodes.length} nodes; up to ${MAX_NODES} are read`);
  const parents = nodes.map(() => -1);
  nodes.forEach(({ children }, parent) => {
    for (const child of children) {
      if (child >= nodes.length || parents[child] !== -1)
        throw damagedGltf('a node has two parents, or is missing');
      parents[child] = parent;
    }
  });
  const all: number[] = [];
  // The last one is taken first, so that roots and children keep the order of the file.
  const waiting = parents.flatMap((parent, node) => (parent < 0 ? [node] : [])).reverse();
  while (waiting.length > 0) {
    const node = waiting.pop()!;
    all.push(node);
    waiting.push(...nodes[node]!.children.toReversed());
  }
  if (all.length < nodes.length) throw damagedGltf('its nodes form a circle');
  const skinned = new Set(skins.flatMap(({ joints }) => joints));
  const kept = new Set<number>();
  for (const node of all.toReversed()) {
    const { mesh, children } = nodes[node]!;
    const isJoint = mesh === undefined || skinned.size === 0 || skinned.has(node) || names.has(node);
    if (isJoint || children.some((child) => kept.has(child))) kept.add(node);
  }
  const order = all.filter((node) => kept.has(node));
  const places = new Map(order.map((node, place) => [node, place]));
  return {
    nodes: order,
    joints: order.map((node) => ({
      name: names.get(node) ?? (nodes[node]!.name ?? `node ${node}`).slice(0, 200),
      parent: parents[node]! < 0 ? -1 : places.get(parents[node]!)!,
    })),
    rest: order.map((node) => transformOf(nodes[node]!)),
  };
}

const placeOf = (matrix: Matrix4): Vec3 => new Vector3().setFromMatrixPosition(matrix).toArray();

/**
 * Poses at times in seconds, null for the rest pose. Rotations are those of the nodes; translations are such that every
 * joint is where its file has it, scales of all kinds included.
 */
export function posesOf(
  { joints, nodes, rest }: Skeleton,
  tracks: Tracks,
  times: readonly (number | null)[],
): LocalPoses {
  const rotations = new Float32Array(times.length * joints.length * 4);
  const translations = new Float32Array(times.length * joints.length * 3);
  times.forEach((time, frame) => {
    const world: Matrix4[] = [];
    const turns: Quat[] = [];
    joints.forEach(({ parent }, joint) => {
      const still = rest[joint]!;
      const value = (path: string): number[] | null => {
        const track = time === null ? undefined : tracks.get(`${nodes[joint]!} ${path}`);
        return track && time !== null ? valueAt(track, time) : null;
      };
      const turn = normaliseQuat((value('rotation') ?? still.turn) as unknown as Quat);
      const matrix = new Matrix4().compose(
        new Vector3(...((value('translation') ?? still.place) as Vec3)),
        new Quaternion(...turn),
        new Vector3(...((value('scale') ?? still.size) as Vec3)),
      );
      if (parent >= 0) matrix.premultiply(world[parent]!);
      world.push(matrix);
      turns.push(parent < 0 ? turn : multiply(turns[parent]!, turn));
      const step = sub(placeOf(matrix), parent < 0 ? ZERO : placeOf(world[parent]!));
      writeQuat(rotations, frame * joints.length + joint, turn);
      writeVec(
        translations,
        frame * joints.length + joint,
        parent < 0 ? step : rotate(conjugate(turns[parent]!), step),
      );
    });
  });
  return { rotations, translations };
}
