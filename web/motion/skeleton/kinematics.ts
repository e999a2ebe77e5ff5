import type { MotionClip, SolvedMotion } from './clip';
import { addScaled, multiplyRows, rotateRow } from '../math/rows';
import { J, JOINT_COUNT, PARENTS } from './skeleton';

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

/** The joints of the rest pose, 22 x 3 metres, with the root at the origin. @param offsets as in `forwardKinematics` */
export function restPositions(offsets: Float32Array): Float32Array {
  const positions = offsets.slice();
  for (let i = 3; i < positions.length; i++)
    positions[i]! += positions[PARENTS[Math.floor(i / 3)]! * 3 + (i % 3)]!;
  return positions;
}

/** How far the sole lies below the toe joint (ball of the foot): its height in a standing foot, metres. */
export const SOLE = 0.03;
/** How far the crown of the head is above its joint, metres. */
export const CROWN = 0.18;

/** Root of the rest pose that GLB holds: standing on the floor where the dance begins, metres. */
export function restRoot({ offsets, root }: SolvedMotion): [number, number, number] {
  return [root[0]!, restRootHeight(offsets), root[2]!];
}

/** Height of the root above the floor in the rest pose, metres. */
export function restRootHeight(offsets: Float32Array): number {
  const heights = restPositions(offsets).filter((_, i) => i % 3 === 1);
  return SOLE - Math.min(...heights);
}

/** Height of a dancer who stands straight, from the floor to the crown of the head, metres. */
export function standingHeight(offsets: Float32Array): number {
  return restRootHeight(offsets) + restPositions(offsets)[J.head * 3 + 1]! + CROWN;
}

/**
 * The same dance in another body: every joint is turned as before, and what the skeleton did not fit is kept. Over the floor
 * the root moves `scale` times as far, and its height changes with the length of the legs.
 *
 * @param clip the dance as it was read
 * @param fitted the same on a skeleton, `solve`
 * @param offsets rest offsets of the other body, as in `forwardKinematics`
 * @param scale of the other body to this one
 * @returns frames x 22 x 3, metres
 */
export function inBody(
  clip: MotionClip,
  fitted: SolvedMotion,
  offsets: Float32Array,
  scale: number,
): Float32Array {
  const legs = restRootHeight(offsets) / restRootHeight(fitted.offsets);
  const root = fitted.root.map((value, i) => value * (i % 3 === 1 ? legs : scale));
  const positions = forwardKinematics(offsets, root, fitted.rotations);
  return positions.map((value, i) => value + scale * (clip.positions[i]! - fitted.positions[i]!));
}
