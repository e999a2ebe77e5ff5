import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { forwardKinematics } from '../skeleton/kinematics';
import { multiplyInverseInto } from '../math/flat-quaternions';
import { dotAt } from '../math/flat-vectors';
import { bonesOf, fitPoses } from './pose-fit';
import { restOffsets, trunkRotations } from './rest-pose';
import { JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import { worldRotations } from './world-rotations';

/** Rotations relative to the parent, frames x 22 x 4, of world rotations; no sign changes from frame to frame. */
function localRotations(world: Float64Array): Float32Array {
  const row = 4 * JOINT_COUNT;
  const local = new Float32Array(world.length);
  const own = new Float64Array(4);
  const before = new Float64Array(row);
  for (let first = 0; first < world.length; first += row) {
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const at = 4 * joint;
      const parent = PARENTS[joint]!;
      if (parent < 0) own.set(world.subarray(first, first + 4));
      else multiplyInverseInto(own, 0, world, first + 4 * parent, world, first + at);
      const sign = dotAt(own, 0, before, at) + own[3]! * before[at + 3]! < 0 ? -1 : 1;
      for (let i = 0; i < 4; i++) {
        before[at + i] = own[i]! * sign;
        local[first + at + i] = before[at + i]!;
      }
    }
  }
  return local;
}

/** Mean distance between joints at two times frames x 22 x 3, metres. */
function meanDistance(a: Float32Array, b: Float32Array): number {
  let sum = 0;
  for (let i = 0; i < a.length; i += 3) {
    const x = a[i]! - b[i]!;
    const y = a[i + 1]! - b[i + 1]!;
    const z = a[i + 2]! - b[i + 2]!;
    sum += Math.sqrt(x * x + y * y + z * z);
  }
  return sum / (a.length / 3);
}

/**
 * Inverse kinematics: fits a skeleton with constant bone lengths to joint positions and finds its rotations.
 *
 * Bone lengths are medians over time, the same left and right. In every frame the trunk is fitted as two rigid parts
 * joined by the spine, the limbs are fitted to the observed joints, and the root is where the squared error is least.
 * Twists of the limbs come from knees, feet and elbows and are smoothed over time; rotations that positions do not show
 * (wrists and head) are those of rest. Quaternions do not change sign from frame to frame. Pure.
 *
 * @param clip at least one frame
 */
export function solve(clip: MotionClip): SolvedMotion {
  const { frames, fps } = clip;
  const observed = new Float64Array(clip.positions);
  const trunk = trunkRotations(observed);
  const offsets = restOffsets(observed, trunk);
  const bones = bonesOf(offsets);
  const poses = fitPoses(observed, bones, trunk);
  const rotations = localRotations(worldRotations(poses, bones));
  const root = new Float32Array(frames * 3);
  for (let i = 0; i < root.length; i++) {
    root[i] = poses.joints[Math.floor(i / 3) * JOINT_COUNT * 3 + (i % 3)]!;
  }
  const positions = forwardKinematics(offsets, root, rotations);
  return {
    fps,
    frames,
    offsets,
    root,
    rotations,
    positions,
    fitError: meanDistance(positions, clip.positions),
  };
}
