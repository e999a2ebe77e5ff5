import type { SolvedMotion } from '../../motion/skeleton/clip';
import { ARMS, LEGS } from '../../motion/skeleton/limbs';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';

/** Distance from the wrist to the middle of the hand, metres. */
const PALM = 0.09;

/** Number of end effectors: two hands, then two feet. */
export const END_EFFECTORS = ARMS.length + LEGS.length;

/**
 * Positions of the end effectors over a motion: frames x 4 x 3 metres, left hand, right hand, left foot, right foot. A
 * hand is its middle, in line with the forearm.
 */
export function endEffectorTracks({
  frames,
  positions,
}: Pick<SolvedMotion, 'frames' | 'positions'>): Float32Array {
  const tracks = new Float32Array(frames * END_EFFECTORS * 3);
  for (let frame = 0; frame < frames; frame++) {
    const joint = (index: number, axis: number): number =>
      positions[(frame * JOINT_COUNT + index) * 3 + axis]!;
    const at = frame * END_EFFECTORS * 3;
    ARMS.forEach(({ middle: elbow, end: wrist }, hand) => {
      const forearm = [0, 1, 2].map((axis) => joint(wrist, axis) - joint(elbow, axis));
      const share = PALM / Math.max(1e-6, Math.hypot(...forearm));
      for (let axis = 0; axis < 3; axis++)
        tracks[at + hand * 3 + axis] = joint(wrist, axis) + forearm[axis]! * share;
    });
    LEGS.forEach(({ toe }, i) => {
      for (let axis = 0; axis < 3; axis++) tracks[at + (ARMS.length + i) * 3 + axis] = joint(toe, axis);
    });
  }
  return tracks;
}

/**
 * Position of an end effector between frames, on a Catmull-Rom spline through its track; written to `out` in metres.
 *
 * @param at moment in frames; clamped to the motion
 */
export function endEffectorAt(
  tracks: Float32Array,
  effector: number,
  at: number,
  out: { x: number; y: number; z: number },
): void {
  const last = tracks.length / (END_EFFECTORS * 3) - 1;
  const clamped = Math.min(Math.max(0, at), last);
  const frame = Math.min(Math.floor(clamped), Math.max(0, last - 1));
  const t = clamped - frame;
  const value = (offset: number, axis: number): number =>
    tracks[(Math.min(Math.max(0, frame + offset), last) * END_EFFECTORS + effector) * 3 + axis]!;
  const along = (axis: number): number => {
    const [a, b, c, d] = [value(-1, axis), value(0, axis), value(1, axis), value(2, axis)];
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
  };
  out.x = along(0);
  out.y = along(1);
  out.z = along(2);
}
