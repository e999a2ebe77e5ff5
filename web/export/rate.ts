import { forwardKinematics } from '../motion/skeleton/kinematics';
import { FPS, type SolvedMotion } from '../motion/skeleton/clip';
import { JOINT_COUNT } from '../motion/skeleton/skeleton';
import { readQuat, slerp, writeQuat } from '../motion/math/quat';
import type { Dance } from './dance';

/** Frame rates in which motions are written: of films, of PAL video, of the page, of games. */
export const FRAME_RATES = [24, 25, FPS, 60] as const;
export type FrameRate = (typeof FRAME_RATES)[number];

/** The dance with so many frames a second, from its first frame to the last one that fits; the same at its own rate. */
export function atFrameRate(dance: Dance, rate: FrameRate): Dance {
  const { dancers, about } = dance;
  if (dancers.every(({ motion }) => motion.fps === rate)) return dance;
  return {
    dancers: dancers.map(({ role, motion }) => ({ role, motion: resampled(motion, rate) })),
    about: { ...about, shift: (about.shift * rate) / FPS },
  };
}

/** Between two frames the root goes in a line and every joint turns evenly, so that bones keep their lengths. */
function resampled(motion: SolvedMotion, rate: number): SolvedMotion {
  const { fps, frames: before, offsets } = motion;
  const frames = Math.floor(((before - 1) * rate) / fps) + 1;
  const root = new Float32Array(frames * 3);
  const rotations = new Float32Array(frames * JOINT_COUNT * 4);
  for (let frame = 0; frame < frames; frame++) {
    const at = (frame * fps) / rate;
    const from = Math.min(Math.floor(at), before - 1);
    const to = Math.min(from + 1, before - 1);
    const share = at - from;
    for (let axis = 0; axis < 3; axis++)
      root[frame * 3 + axis] =
        (1 - share) * motion.root[from * 3 + axis]! + share * motion.root[to * 3 + axis]!;
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const start = readQuat(motion.rotations, from * JOINT_COUNT + joint);
      const end = readQuat(motion.rotations, to * JOINT_COUNT + joint);
      writeQuat(rotations, frame * JOINT_COUNT + joint, slerp(start, end, share));
    }
  }
  return {
    ...motion,
    fps: rate,
    frames,
    root,
    rotations,
    positions: forwardKinematics(offsets, root, rotations),
  };
}
