import { solve } from '../../motion/fit/ik';
import type { MotionClip, SolvedMotion } from '../../motion/skeleton/clip';
import { headingOf } from '../../motion/skeleton/heading';
import { JOINT_COUNT, MIRROR } from '../../motion/skeleton/skeleton';

/** How far ahead of the leader's first place the mirror stands, metres. */
const DISTANCE = 0.45;

/** A partner who dances as the leader's image in a mirror that stands still before the leader: a simple baseline. */
export function mirrored({ positions, frames, fps }: MotionClip): SolvedMotion {
  const heading = headingOf(positions.subarray(0, JOINT_COUNT * 3));
  const [nx, nz] = [Math.sin(heading), Math.cos(heading)];
  const offset = positions[0]! * nx + positions[2]! * nz + DISTANCE;
  const image = new Float32Array(positions.length);
  for (let frame = 0; frame < frames; frame++) {
    for (let joint = 0; joint < JOINT_COUNT; joint++) {
      const from = 3 * (frame * JOINT_COUNT + MIRROR[joint]!);
      const [x, y, z] = [positions[from]!, positions[from + 1]!, positions[from + 2]!];
      const through = 2 * (x * nx + z * nz - offset);
      image.set([x - through * nx, y, z - through * nz], 3 * (frame * JOINT_COUNT + joint));
    }
  }
  return solve({ fps, frames, positions: image });
}
