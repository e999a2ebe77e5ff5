import { addScaled, multiplyRows, rotateRow } from '../math/rows';
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
  // One frame: rotations, local at first, and positions, both in world axes.
  const world = new Float64Array(JOINT_COUNT * 4);
  const placed = new Float64Array(JOINT_COUNT * 3);
  for (let frame = 0; frame < frames; frame++) {
    world.set(rotations.subarray(frame * world.length, (frame + 1) * world.length));
    placed.set(root.subarray(3 * frame, 3 * frame + 3));
    for (let joint = 1; joint < JOINT_COUNT; joint++) {
      const parent = PARENTS[joint]!;
      rotateRow(placed, joint, world, parent, bones, joint);
      addScaled(placed, joint, placed, parent, placed, joint, 1);
      multiplyRows(world, joint, world, parent, world, joint);
    }
    positions.set(placed, frame * placed.length);
  }
  return positions;
}
