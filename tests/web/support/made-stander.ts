import type { SolvedMotion } from '../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../web/motion/skeleton/kinematics';
import { aboutAxis, writeQuat } from '../../../web/motion/math/quat';
import { J, JOINT_COUNT } from '../../../web/motion/skeleton/skeleton';
import { madeDancer } from './made-dancer';

export interface StanderOptions {
  readonly frames: number;
  /** Position over the floor, metres; the feet slide along with it. */
  readonly path?: (frame: number) => readonly [number, number];
  /** How far the left foot is lifted, 0 to 1 (29 cm). */
  readonly lift?: (frame: number) => number;
  /** Flexion of a standing hip, radians; the knee bends by twice as much, and the foot is level. */
  readonly bend?: number;
}

/** A dancer who stands on level feet with bent knees and is moved along a path. */
export function madeStander({ frames, path, lift, bend = 0.35 }: StanderOptions): SolvedMotion {
  const { offsets } = madeDancer({ frames: 1 });
  const root = new Float32Array(frames * 3);
  const rotations = new Float32Array(frames * JOINT_COUNT * 4).map((_, i) => (i % 4 === 3 ? 1 : 0));
  for (let frame = 0; frame < frames; frame++) {
    const [x, z] = path?.(frame) ?? [0, 0];
    root.set([x, 0.16 + 0.83 * Math.cos(bend), z], 3 * frame);
    const turn = (joint: number, angle: number): void =>
      writeQuat(rotations, frame * JOINT_COUNT + joint, aboutAxis([1, 0, 0], angle));
    const legs = [
      [J.left_hip, J.left_knee, J.left_ankle, bend + 0.6 * (lift?.(frame) ?? 0)],
      [J.right_hip, J.right_knee, J.right_ankle, bend],
    ] as const;
    for (const [hip, knee, ankle, angle] of legs) {
      turn(hip, -angle);
      turn(knee, 2 * angle);
      turn(ankle, -angle);
    }
  }
  const positions = forwardKinematics(offsets, root, rotations);
  return { fps: 30, frames, offsets, root, rotations, positions, fitError: 0 };
}

/** Smoothstep from 0 at frame `from` to 1 at frame `to`. */
export function eased(frame: number, from: number, to: number): number {
  const t = Math.min(1, Math.max(0, (frame - from) / (to - from)));
  return t * t * (3 - 2 * t);
}
