import { Quaternion } from 'three';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { SolvedMotion } from '../../motion/skeleton/clip';

/** Pose of a dancer at one moment. */
export interface Pose {
  /** x, y, z in metres. */
  readonly root: Float32Array;
  /** 22 x 4 local rotations, xyzw. */
  readonly rotations: Float32Array;
}

export const createPose = (): Pose => ({
  root: new Float32Array(3),
  rotations: new Float32Array(JOINT_COUNT * 4),
});

/**
 * Writes the pose of `motion` at `seconds` into `out`, between frames by lerp of the root and slerp of the joints.
 * Moments before the first and after the last frame hold that frame.
 */
export function samplePose(motion: SolvedMotion, seconds: number, out: Pose): void {
  const at = Math.min(Math.max(0, seconds * motion.fps), motion.frames - 1);
  const frame = Math.floor(at);
  const next = Math.min(frame + 1, motion.frames - 1);
  const t = at - frame;
  for (let axis = 0; axis < 3; axis++) {
    const a = motion.root[frame * 3 + axis]!;
    out.root[axis] = a + (motion.root[next * 3 + axis]! - a) * t;
  }
  const width = JOINT_COUNT * 4;
  const from = motion.rotations.subarray(frame * width, (frame + 1) * width);
  const to = motion.rotations.subarray(next * width, (next + 1) * width);
  for (let joint = 0; joint < width; joint += 4) slerp(from, to, joint, t, out.rotations);
}

/** Moves the pose `out` towards another one: 0 leaves it, 1 makes it the other. */
export function blendPose(out: Pose, to: Pose, t: number): void {
  for (let axis = 0; axis < 3; axis++) out.root[axis]! += (to.root[axis]! - out.root[axis]!) * t;
  for (let joint = 0; joint < JOINT_COUNT * 4; joint += 4)
    slerp(out.rotations, to.rotations, joint, t, out.rotations);
}

/** Shortest-arc spherical interpolation between the quaternions at `at` in two poses, written to `out` there. */
function slerp(from: Float32Array, to: Float32Array, at: number, t: number, out: Float32Array): void {
  Quaternion.slerpFlat(plain(out), at, plain(from), at, plain(to), at, t);
}

/** three.js takes any array here, its types only plain ones. */
const plain = (values: Float32Array): number[] => values as unknown as number[];
