import type { LocalPoses, MotionSource, SourceJoint } from './source';
import { multiply, type Quat, readQuat, rotate, slerp, writeQuat } from '../math/quat';
import { add, lerp, readVec, type Vec3, writeVec } from '../math/vec3';

/** Some joints of a file over time, in the file's own unit and axes. */
export interface NodeMotion {
  readonly frames: number;
  /** World positions of a joint: frames x 3. */
  readonly position: (node: number) => Float64Array;
  /** World rotations of a joint: frames x 4, xyzw. */
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

/** World transforms of one pose: joints x 3 and joints x 4. */
interface WorldPose {
  readonly places: readonly Vec3[];
  readonly turns: readonly Quat[];
}

/** Forward kinematics of the joints in `order`, parents first, from their transforms from the parent. */
function placeJoints(
  joints: readonly SourceJoint[],
  order: readonly number[],
  rotationOf: (joint: number) => Quat,
  translationOf: (joint: number) => Vec3,
): WorldPose {
  const places: Vec3[] = [];
  const turns: Quat[] = [];
  for (const joint of order) {
    const { parent } = joints[joint]!;
    const [local, step] = [rotationOf(joint), translationOf(joint)];
    turns[joint] = parent < 0 ? local : multiply(turns[parent]!, local);
    places[joint] = parent < 0 ? step : add(places[parent]!, rotate(turns[parent]!, step));
  }
  return { places, turns };
}

/** World transforms of one of several poses. */
export function worldPose(joints: readonly SourceJoint[], poses: LocalPoses, frame: number): WorldPose {
  const at = (joint: number): number => frame * joints.length + joint;
  return placeJoints(
    joints,
    [...joints.keys()],
    (joint) => readQuat(poses.rotations, at(joint)),
    (joint) => readVec(poses.translations, at(joint)),
  );
}

/**
 * World motion of `nodes` (and their ancestors) at the rate `to`, from a file whose frames have the rate
 * `from`. Rotations are interpolated before the joints are placed, so limbs keep their lengths between frames.
 */
export function sampleNodes(
  source: MotionSource,
  nodes: readonly number[],
  from: number,
  to: number,
): NodeMotion {
  const times = resampleTimes(source.frames, from, to);
  const wanted = [...new Set(times.flatMap(({ before, after }) => [before, after]))].sort((a, b) => a - b);
  const slots = new Map(wanted.map((frame, slot) => [frame, slot]));
  const poses = source.localPoses(wanted);

  const needed = new Set<number>();
  for (let node of nodes) for (; node >= 0; node = source.joints[node]!.parent) needed.add(node);
  const order = [...needed].sort((a, b) => a - b);
  const places = new Map(order.map((node) => [node, new Float64Array(times.length * 3)]));
  const turns = new Map(order.map((node) => [node, new Float64Array(times.length * 4)]));

  times.forEach(({ before, after, share }, frame) => {
    const a = slots.get(before)! * source.joints.length;
    const b = slots.get(after)! * source.joints.length;
    const world = placeJoints(
      source.joints,
      order,
      (node) => {
        const start = readQuat(poses.rotations, a + node);
        return share === 0 ? start : slerp(start, readQuat(poses.rotations, b + node), share);
      },
      (node) => {
        const start = readVec(poses.translations, a + node);
        return share === 0 ? start : lerp(start, readVec(poses.translations, b + node), share);
      },
    );
    for (const node of order) {
      writeQuat(turns.get(node)!, frame, world.turns[node]!);
      writeVec(places.get(node)!, frame, world.places[node]!);
    }
  });
  return {
    frames: times.length,
    position: (node) => places.get(node)!,
    rotation: (node) => turns.get(node)!,
  };
}
