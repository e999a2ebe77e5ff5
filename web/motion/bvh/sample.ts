import { readPoses } from './poses';
import type { BvhFile } from './text';
import { multiply, type Quat, readQuat, rotate, slerp, writeQuat } from '../math/quat';
import { add, lerp, readVec, type Vec3, writeVec } from '../math/vec3';

/** Some nodes of a file over time, in the file's own unit and axes. */
export interface NodeMotion {
  readonly frames: number;
  /** World positions of a node: frames x 3. */
  readonly position: (node: number) => Float64Array;
  /** World rotations of a node: frames x 4, xyzw. */
  readonly rotation: (node: number) => Float64Array;
}

/** For every output frame the two frames of the file around it, and its place between them (0 to 1). */
function resampleTimes(
  frames: number,
  from: number,
  to: number,
): { before: number; after: number; share: number }[] {
  // The tolerance keeps the last frame when the rates divide evenly but the quotient is not exact.
  const count = Math.floor(((frames - 1) / from) * to + 1e-6) + 1;
  return Array.from({ length: count }, (_, i) => {
    const at = Math.min((i * from) / to, frames - 1);
    const nearest = Math.round(at);
    if (Math.abs(at - nearest) < 1e-6) return { before: nearest, after: nearest, share: 0 };
    const before = Math.floor(at);
    return { before, after: before + 1, share: at - before };
  });
}

/**
 * World motion of `nodes` (and their ancestors) at the rate `to`, from a file whose frames have the rate
 * `from`. Rotations are interpolated before the joints are placed, so limbs keep their lengths between frames.
 */
export function sampleNodes(file: BvhFile, nodes: readonly number[], from: number, to: number): NodeMotion {
  const times = resampleTimes(file.frameLines.length, from, to);
  const wanted = [...new Set(times.flatMap(({ before, after }) => [before, after]))].sort((a, b) => a - b);
  const slots = new Map(wanted.map((frame, slot) => [frame, slot]));
  const poses = readPoses(file, wanted);

  const needed = new Set<number>();
  for (let node of nodes) for (; node >= 0; node = file.nodes[node]!.parent) needed.add(node);
  const order = [...needed].sort((a, b) => a - b);
  const places = new Map(order.map((node) => [node, new Float64Array(times.length * 3)]));
  const turns = new Map(order.map((node) => [node, new Float64Array(times.length * 4)]));

  times.forEach(({ before, after, share }, frame) => {
    const a = slots.get(before)! * file.nodes.length;
    const b = slots.get(after)! * file.nodes.length;
    const worldPlace = [] as Vec3[];
    const worldTurn = [] as Quat[];
    for (const node of order) {
      const [qa, qb] = [readQuat(poses.rotations, a + node), readQuat(poses.rotations, b + node)];
      const [pa, pb] = [readVec(poses.translations, a + node), readVec(poses.translations, b + node)];
      const local = share === 0 ? qa : slerp(qa, qb, share);
      const step = share === 0 ? pa : lerp(pa, pb, share);
      const { parent } = file.nodes[node]!;
      const turn = parent < 0 ? local : multiply(worldTurn[parent]!, local);
      const place = parent < 0 ? step : add(worldPlace[parent]!, rotate(worldTurn[parent]!, step));
      worldTurn[node] = turn;
      worldPlace[node] = place;
      writeQuat(turns.get(node)!, frame, turn);
      writeVec(places.get(node)!, frame, place);
    }
  });
  return {
    frames: times.length,
    position: (node) => places.get(node)!,
    rotation: (node) => turns.get(node)!,
  };
}
