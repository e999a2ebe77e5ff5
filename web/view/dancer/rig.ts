import { Bone, Matrix4, Quaternion, Skeleton, Vector3 } from 'three';
import { JOINT_COUNT, PARENTS, SMPL22 } from '../../motion/skeleton/skeleton';
import { bindPose } from '../body/bind-pose';
import type { Pose } from './pose';

/** The 22 bones of one dancer, at the solved skeleton's own lengths. */
export interface Rig {
  readonly root: Bone;
  readonly bones: readonly Bone[];
  readonly skeleton: Skeleton;
  /** Takes over the bone lengths of a solved skeleton (22 x 3 offsets, metres). */
  fit(offsets: ArrayLike<number>): void;
  /** Binds the skin that was made for these offsets, which may differ a little from the bones (see `BodyLibrary`). */
  bind(offsets: ArrayLike<number>): void;
  apply(pose: Pose): void;
  /** Writes 22 x 3 world positions in metres of the joints as they are posed. */
  jointPositions(out: Float32Array): Float32Array;
}

const Z_AXIS = new Vector3(0, 0, 1);

/** Inverses of the world matrices of the bones in the bind pose. */
function inverseBind(offsets: ArrayLike<number>): Matrix4[] {
  const { joints, turns } = bindPose(offsets);
  return joints.map((joint, i) =>
    new Matrix4()
      .compose(
        new Vector3(...joint),
        new Quaternion().setFromAxisAngle(Z_AXIS, turns[i]!),
        new Vector3(1, 1, 1),
      )
      .invert(),
  );
}

export function createRig(): Rig {
  const bones = SMPL22.map((name) => {
    const bone = new Bone();
    bone.name = name;
    return bone;
  });
  for (let joint = 1; joint < JOINT_COUNT; joint++) bones[PARENTS[joint]!]!.add(bones[joint]!);
  const skeleton = new Skeleton(
    bones,
    bones.map(() => new Matrix4()),
  );
  const root = bones[0]!;
  return {
    root,
    bones,
    skeleton,
    bind(offsets) {
      inverseBind(offsets).forEach((inverse, joint) => skeleton.boneInverses[joint]!.copy(inverse));
    },
    fit(offsets) {
      for (let joint = 1; joint < JOINT_COUNT; joint++)
        bones[joint]!.position.set(offsets[joint * 3]!, offsets[joint * 3 + 1]!, offsets[joint * 3 + 2]);
    },
    apply(pose) {
      root.position.fromArray(pose.root);
      for (let joint = 0; joint < JOINT_COUNT; joint++)
        bones[joint]!.quaternion.fromArray(pose.rotations, joint * 4);
      root.updateMatrixWorld(true);
    },
    jointPositions(out) {
      for (let joint = 0; joint < JOINT_COUNT; joint++) {
        const m = bones[joint]!.matrixWorld.elements;
        out[joint * 3] = m[12]!;
        out[joint * 3 + 1] = m[13]!;
        out[joint * 3 + 2] = m[14]!;
      }
      return out;
    },
  };
}
