import type { SolvedMotion } from '../../motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../motion/skeleton/skeleton';

/** How far beyond the wrist the middle of the hand lies, metres. */
const PALM = 0.09;
const HANDS = [
  [J.left_elbow, J.left_wrist],
  [J.right_elbow, J.right_wrist],
] as const;
const FEET = [J.left_foot, J.right_foot] as const;

/** Hands, then feet. */
export const TIPS = HANDS.length + FEET.length;

/**
 * Where hands and feet are through a dance: frames x 4 x 3 metres, left hand, right hand, left foot, right foot. A hand
 * is its middle, in line with the forearm.
 */
export function tipTracks({ frames, positions }: Pick<SolvedMotion, 'frames' | 'positions'>): Float32Array {
  const tracks = new Float32Array(frames * TIPS * 3);
  for (let frame = 0; frame < frames; frame++) {
    const joint = (index: number, axis: number): number =>
      positions[(frame * JOINT_COUNT + index) * 3 + axis]!;
    const at = frame * TIPS * 3;
    HANDS.forEach(([elbow, wrist], tip) => {
      const reach = [0, 1, 2].map((axis) => joint(wrist, axis) - joint(elbow, axis));
      const share = PALM / Math.max(1e-6, Math.hypot(...reach));
      for (let axis = 0; axis < 3; axis++)
        tracks[at + tip * 3 + axis] = joint(wrist, axis) + reach[axis]! * share;
    });
    FEET.forEach((foot, i) => {
      for (let axis = 0; axis < 3; axis++) tracks[at + (HANDS.length + i) * 3 + axis] = joint(foot, axis);
    });
  }
  return tracks;
}

/**
 * A smooth curve through a track (Catmull-Rom), written to `out`.
 *
 * @param at moment in frames; held at both ends of the dance
 */
export function tipAt(
  tracks: Float32Array,
  tip: number,
  at: number,
  out: { x: number; y: number; z: number },
): void {
  const last = tracks.length / (TIPS * 3) - 1;
  const held = Math.min(Math.max(0, at), last);
  const frame = Math.min(Math.floor(held), Math.max(0, last - 1));
  const t = held - frame;
  const value = (offset: number, axis: number): number =>
    tracks[(Math.min(Math.max(0, frame + offset), last) * TIPS + tip) * 3 + axis]!;
  const along = (axis: number): number => {
    const [a, b, c, d] = [value(-1, axis), value(0, axis), value(1, axis), value(2, axis)];
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
  };
  out.x = along(0);
  out.y = along(1);
  out.z = along(2);
}
