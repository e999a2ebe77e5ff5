import type { Gltf } from './container';
import { humanoidNames } from './humanoid';
import { posesOf, skeletonOf } from './skeleton';
import { conjugate, IDENTITY, multiply, type Quat, writeQuat } from '../../math/quat';
import { readVec, scale, sub, type Vec3, writeVec, ZERO } from '../../math/vec3';
import { worldPose } from '../../retarget/sample';
import { type LocalPoses, type MotionSource, restOf } from '../../retarget/source';

/** A humanoid with its axes along those of the world: every bone's rest place, and the bone above it. */
interface Humanoid {
  readonly names: readonly string[];
  readonly parents: readonly number[];
  readonly places: readonly Vec3[];
}

/** The bones of a body, facing +z as motions do. */
function humanoidOf(body: Gltf): Humanoid {
  const bones = humanoidNames(body);
  const { joints, nodes, rest } = skeletonOf(body, bones);
  const { places } = worldPose(joints, posesOf({ joints, nodes, rest }, new Map(), [null]), 0);
  const isBone = (joint: number): boolean => bones.has(nodes[joint]!);
  const kept = [...joints.keys()].filter(isBone);
  // A body of VRM 0 faces -z.
  const facing = 'VRM' in body.extensions ? -1 : 1;
  return {
    names: kept.map((joint) => joints[joint]!.name),
    places: kept.map((joint) => {
      const [x, y, z] = places[joint]!;
      return [facing * x, y, facing * z];
    }),
    parents: kept.map((joint) => {
      let at = joints[joint]!.parent;
      while (at >= 0 && !isBone(at)) at = joints[at]!.parent;
      return kept.indexOf(at);
    }),
  };
}

/**
 * The motion of a VRMA file on the body of a VRM: rotations relative to the rest pose, in axes of the world, are those of
 * the motion; the hips' way is scaled by the heights of both hips. Bones that the motion does not have turn with those
 * above them.
 * @param bones the source's joint of every bone of the humanoid, -1 for none
 */
export function onBody(source: MotionSource, body: Gltf, bones: ReadonlyMap<string, number>): MotionSource {
  const { names, parents, places } = humanoidOf(body);
  const hips = names.indexOf('hips');
  const from = names.map((name) => bones.get(name) ?? -1);
  if (hips < 0 || from[hips]! < 0) return source;
  const rest = worldPose(source.joints, source.rest, 0);
  const height = rest.places[from[hips]!]![1];
  const ratio = height > 0 ? places[hips]![1] / height : 1;
  const offsets = new Float32Array(
    places.flatMap((place, joint) => sub(place, parents[joint]! < 0 ? ZERO : places[parents[joint]!]!)),
  );
  const localPoses = (wanted: readonly number[]): LocalPoses => {
    const poses = source.localPoses(wanted);
    const out = {
      rotations: new Float32Array(wanted.length * names.length * 4),
      translations: new Float32Array(wanted.length * names.length * 3),
    };
    wanted.forEach((_, frame) => {
      const { turns, places: moved } = worldPose(source.joints, poses, frame);
      /** Rotation of a bone from its rest pose, in axes of the world. */
      const delta = (joint: number): Quat => {
        const at = from[joint]!;
        if (at < 0) return parents[joint]! < 0 ? IDENTITY : delta(parents[joint]!);
        return multiply(turns[at]!, conjugate(rest.turns[at]!));
      };
      names.forEach((_name, joint) => {
        const parent = parents[joint]!;
        const local = parent < 0 ? delta(joint) : multiply(conjugate(delta(parent)), delta(joint));
        writeQuat(out.rotations, frame * names.length + joint, local);
        writeVec(
          out.translations,
          frame * names.length + joint,
          joint === hips ? scale(moved[from[hips]!]!, ratio) : readVec(offsets, joint),
        );
      });
    });
    return out;
  };
  return {
    ...source,
    format: 'VRMA on a VRM',
    joints: names.map((name, joint) => ({ name, parent: parents[joint]! })),
    rest: restOf(offsets),
    localPoses,
  };
}
