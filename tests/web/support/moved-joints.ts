import { expect } from 'vitest';
import { forwardKinematics } from '../../../web/motion/skeleton/kinematics';
import type { SolvedMotion } from '../../../web/motion/skeleton/clip';
import { quatDot, readQuat } from '../../../web/motion/math/quat';
import { distance, readVec, type Vec3 } from '../../../web/motion/math/vec3';
import { FEET, J, JOINT_COUNT } from '../../../web/motion/skeleton/skeleton';

export const at = (motion: SolvedMotion, frame: number, joint: number): Vec3 =>
  readVec(motion.positions, frame * JOINT_COUNT + joint);

/** How far a joint is moved in each frame, metres. */
export function moves(a: SolvedMotion, b: SolvedMotion, joint: number): number[] {
  return Array.from({ length: a.frames }, (_, frame) => distance(at(a, frame, joint), at(b, frame, joint)));
}

export const top = (values: readonly number[]): number => Math.max(...values);

export const LEGS = [
  [J.left_hip, J.left_knee, J.left_ankle],
  [J.right_hip, J.right_knee, J.right_ankle],
] as const;
export const KNEES = LEGS.map(([, knee]) => knee);

/**
 * What holds for every motion of which only some joints were moved: consistent positions, unit quaternions without sign
 * flips, nothing else moved.
 */
export function expectSound(
  free: SolvedMotion,
  moved: SolvedMotion,
  joints: readonly number[] = [...FEET, ...KNEES],
): void {
  const again = forwardKinematics(moved.offsets, moved.root, moved.rotations);
  let apart = 0;
  let unit = 0;
  let flips = 0;
  for (let i = 0; i < moved.frames * JOINT_COUNT; i++) {
    apart = Math.max(apart, distance(readVec(again, i), readVec(moved.positions, i)));
    const q = readQuat(moved.rotations, i);
    unit = Math.max(unit, Math.abs(quatDot(q, q) - 1));
    if (i >= JOINT_COUNT && quatDot(q, readQuat(moved.rotations, i - JOINT_COUNT)) < 0) flips++;
  }
  expect(moved.positions.every(Number.isFinite)).toBe(true);
  // Drawn joints are those of the exported rotations, and so bones are as long as their offsets.
  expect(apart).toBeLessThan(1e-5);
  expect(unit).toBeLessThan(1e-5);
  expect(flips).toBe(0);
  expect(moved.offsets).toEqual(free.offsets);
  expect(moved.root).toEqual(free.root);
  for (let joint = 0; joint < JOINT_COUNT; joint++) {
    if (joints.includes(joint)) continue;
    expect(top(moves(free, moved, joint))).toBe(0);
  }
}
