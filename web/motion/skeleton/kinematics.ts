import { multiply, type Quat, readQuat, rotate } from '../math/quat';
import { JOINT_COUNT, PARENTS } from './skeleton';
import { add, readVec, type Vec3, writeVec } from '../math/vec3';

/**
 * Forward kinematics: joint positions of a skeleton in motion.
 *
 * @param offsets 22 x 3 rest offsets from the parent, metres
 * @param root frames x 3 root positions, metres
 * @param rotations frames x 22 x 4 local rotations xyzw
 * @returns frames x 22 x 3, metres
 */
export function forwardKinematics(
  offsets: Float32Array,
  root: Float32Array,
  rotations: Float32Array,
): Float32Array {
  const frames = root.length / 3;
  const positions = new Float32Array(frames * JOINT_COUNT * 3);
  const bones = PARENTS.map((_, joint) => readVec(offsets, joint));
  const world: Quat[] = [];
  const placed: Vec3[] = [];
  for (let frame = 0; frame < frames; frame++) {
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const parent = PARENTS[joint]!;
      const local = readQuat(rotations, frame * JOINT_COUNT + joint);
      world[joint] = parent < 0 ? local : multiply(world[parent]!, local);
      const place =
        parent < 0 ? readVec(root, frame) : add(placed[parent]!, rotate(world[parent]!, bones[joint]!));
      placed[joint] = place;
      writeVec(positions, frame * JOINT_COUNT + joint, place);
    }
  }
  return positions;
}
