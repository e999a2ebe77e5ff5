import type { SolvedMotion } from '../../motion/skeleton/clip';
import { forwardKinematics } from '../../motion/skeleton/kinematics';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { FrameRange } from '../store/state';

/** Frames over which one motion passes into the other, a quarter of a second. */
const PASSAGE = 8;

/**
 * `shown` with the frames of `fresh` taken from another motion of the same length. It keeps the bones of `shown`;
 * at both ends of the fresh part, unless the dance itself ends there, one passes into the other.
 */
export function splice(shown: SolvedMotion, made: SolvedMotion, { from, to }: FrameRange): SolvedMotion {
  const root = shown.root.slice();
  const rotations = shown.rotations.slice();
  const positions = shown.positions.slice();
  for (let frame = from; frame < to; frame++) {
    const entering = from === 0 ? 1 : (frame - from + 1) / (PASSAGE + 1);
    const leaving = to === shown.frames ? 1 : (to - frame) / (PASSAGE + 1);
    const weight = Math.min(1, entering, leaving);
    for (let i = frame * 3; i < frame * 3 + 3; i++)
      root[i] = (root[i] ?? 0) + ((made.root[i] ?? 0) - (root[i] ?? 0)) * weight;
    for (let joint = 0; joint < JOINT_COUNT; joint++)
      turn(rotations, made.rotations, (frame * JOINT_COUNT + joint) * 4, weight);
  }
  const part = forwardKinematics(
    shown.offsets,
    root.subarray(from * 3, to * 3),
    rotations.subarray(from * JOINT_COUNT * 4, to * JOINT_COUNT * 4),
  );
  positions.set(part, from * JOINT_COUNT * 3);
  return { ...shown, root, rotations, positions };
}

/** Moves the quaternion at `at` towards that of `to`, the short way; between poses so near a straight line will do. */
function turn(rotations: Float32Array, to: Float32Array, at: number, weight: number): void {
  const [a, b] = [rotations.subarray(at, at + 4), to.subarray(at, at + 4)];
  const dot = a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
  const sign = dot < 0 ? -1 : 1;
  const mixed = a.map((value, i) => value * (1 - weight) + sign * (b[i] ?? 0) * weight);
  const length = Math.hypot(...mixed);
  a.set(mixed.map((value) => value / length));
}
