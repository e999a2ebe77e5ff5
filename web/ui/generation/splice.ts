import type { SolvedMotion } from '../../motion/skeleton/clip';
import { forwardKinematics } from '../../motion/skeleton/kinematics';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { FrameRange } from '../store/state';

/** Frames of the crossfade between the two motions, about a quarter of a second. */
const CROSSFADE_FRAMES = 8;

/**
 * Replaces frames of a motion by a newer part of it.
 * @param shown the motion whose bone lengths the result has
 * @param made a motion of `to - from` frames
 * @param fresh where they go; at both ends, unless the dance ends there, the two are crossfaded
 */
export function splice(shown: SolvedMotion, made: SolvedMotion, { from, to }: FrameRange): SolvedMotion {
  const root = shown.root.slice();
  const rotations = shown.rotations.slice();
  const positions = shown.positions.slice();
  for (let frame = from; frame < to; frame++) {
    const entering = from === 0 ? 1 : (frame - from + 1) / (CROSSFADE_FRAMES + 1);
    const leaving = to === shown.frames ? 1 : (to - frame) / (CROSSFADE_FRAMES + 1);
    const weight = Math.min(1, entering, leaving);
    for (let i = frame * 3; i < frame * 3 + 3; i++)
      root[i] = (root[i] ?? 0) + ((made.root[i - from * 3] ?? 0) - (root[i] ?? 0)) * weight;
    const first = frame * JOINT_COUNT * 4;
    const newer = made.rotations.subarray((frame - from) * JOINT_COUNT * 4, (frame - from + 1) * JOINT_COUNT * 4);
    nlerpAll(rotations.subarray(first, first + JOINT_COUNT * 4), newer, weight);
  }
  const part = forwardKinematics(
    shown.offsets,
    root.subarray(from * 3, to * 3),
    rotations.subarray(from * JOINT_COUNT * 4, to * JOINT_COUNT * 4),
  );
  positions.set(part, from * JOINT_COUNT * 3);
  return { ...shown, root, rotations, positions };
}

/** Normalised linear interpolation of quaternions towards `to`, along the shorter arcs. */
function nlerpAll(rotations: Float32Array, to: Float32Array, weight: number): void {
  for (let at = 0; at < rotations.length; at += 4) {
    const [a, b] = [rotations.subarray(at, at + 4), to.subarray(at, at + 4)];
    const dot = a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
    const sign = dot < 0 ? -1 : 1;
    const mixed = a.map((value, i) => value * (1 - weight) + sign * (b[i] ?? 0) * weight);
    const length = Math.hypot(...mixed);
    a.set(mixed.map((value) => value / length));
  }
}
