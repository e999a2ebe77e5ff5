import { multiplyInto, rotateInto } from '../math/flat-quaternions';
import { addInto } from '../math/flat-vectors';
import { JOINT_COUNT, PARENTS } from './skeleton';

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
  const bones = new Float64Array(offsets);
  // One frame: world rotations, positions, and the world vector of one bone.
  const world = new Float64Array(JOINT_COUNT * 4);
  const placed = new Float64Array(JOINT_COUNT * 3);
  const bone = new Float64Array(3);
  for (let frame = 0; frame < frames; frame++) {
    const first = frame * JOINT_COUNT * 4;
    for (let i = 0; i < world.length; i++) world[i] = rotations[first + i]!;
    for (let i = 0; i < 3; i++) placed[i] = root[3 * frame + i]!;
    for (let joint = 1; joint < JOINT_COUNT; joint++) {
      const parent = PARENTS[joint]!;
      rotateInto(bone, 0, world, 4 * parent, bones, 3 * joint);
      addInto(placed, 3 * joint, placed, 3 * parent, bone, 0);
      multiplyInto(world, 4 * joint, world, 4 * parent, world, 4 * joint);
    }
    positions.set(placed, frame * placed.length);
  }
  return positions;
}
