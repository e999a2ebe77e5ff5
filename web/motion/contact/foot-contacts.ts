import type { MotionClip, SolvedMotion } from '../skeleton/clip';
import { FEET, JOINT_COUNT, PARENTS } from '../skeleton/skeleton';
import { percentile, runsBelow } from '../math/statistics';

/** Heights of one joint and its speeds. */
interface JointTrack {
  /** One a frame, metres. */
  readonly heights: Float64Array;
  /** Up or down and over the floor, from each frame to the next, m/s: frames - 1 values. */
  readonly vertical: Float64Array;
  readonly horizontal: Float64Array;
}

function jointTrack({ positions, frames, fps }: MotionClip, joint: number): JointTrack {
  const heights = new Float64Array(frames);
  const vertical = new Float64Array(Math.max(0, frames - 1));
  const horizontal = new Float64Array(Math.max(0, frames - 1));
  for (let frame = 0; frame < frames; frame++) {
    const at = (frame * JOINT_COUNT + joint) * 3;
    const next = at + JOINT_COUNT * 3;
    heights[frame] = positions[at + 1]!;
    if (frame === frames - 1) break;
    vertical[frame] = Math.abs(positions[next + 1]! - positions[at + 1]!) * fps;
    const x = positions[next]! - positions[at]!;
    const z = positions[next + 2]! - positions[at + 2]!;
    horizontal[frame] = Math.hypot(x, z) * fps;
  }
  return { heights, vertical, horizontal };
}

/** When a joint of the foot counts as standing on the floor: the model's manifest has these numbers. */
export interface ContactRule {
  /** The joint's own resting height is this percentile of its heights. */
  readonly percentile: number;
  /** Metres above it up to which the joint touches the floor. */
  readonly height: number;
  /** A joint in contact rises or sinks slower than this, m/s. */
  readonly vertical_speed: number;
}

/** Contact and speed over the floor in m/s of ankles and toes, from each frame to the next: (frames - 1) x 4. */
export interface FootContacts {
  readonly inContact: Uint8Array;
  readonly speed: Float64Array;
}

/**
 * Which joints of the feet stand, and how fast they move over the floor: `contacts` of training/motion/foot_contact.py.
 * Measured against each joint's own low heights, so neither the floor nor the foot's thickness matters.
 */
export function footContacts(clip: MotionClip, rule: ContactRule): FootContacts {
  const steps = Math.max(0, clip.frames - 1);
  const inContact = new Uint8Array(steps * FEET.length);
  const speed = new Float64Array(steps * FEET.length);
  FEET.forEach((joint, foot) => {
    const { heights, vertical, horizontal } = jointTrack(clip, joint);
    const low = percentile(heights, rule.percentile) + rule.height;
    for (let frame = 0; frame < steps; frame++) {
      const sample = frame * FEET.length + foot;
      inContact[sample] = Number(heights[frame]! < low && vertical[frame]! < rule.vertical_speed);
      speed[sample] = horizontal[frame]!;
    }
  });
  return { inContact, speed };
}

/** Speed over the floor of the slowest joint of both feet, m/s, from each frame to the next; frames - 1 numbers. */
export function slowestFootSpeed(clip: MotionClip): Float64Array {
  const speeds = FEET.map((joint) => jointTrack(clip, joint).horizontal);
  return speeds[0]!.map((_, frame) => Math.min(...speeds.map((speed) => speed[frame]!)));
}

/** Thresholds of the speed over the floor, m/s: a contact falls below the first, and ends above the second. */
export const CONTACT_SPEED = 0.5;
export const RELEASE_SPEED = 0.9;
/** A joint in contact rises or sinks slower than this, m/s. */
const VERTICAL_SPEED = 0.2;
/**
 * Toes in contact are at most this high above the floor, metres, and ankles by as much more as they are above the toes
 * at rest: generated feet hover while they stand. It is no measure of the clip, so that contacts of a part of a dance
 * are those of the whole.
 */
const MAX_TOE_HEIGHT = 0.09;
/** Shortest contact, seconds. */
const MIN_DURATION = 0.13;

/** Frames of a contact: from `first` on, up to and with `last`. */
export interface ContactInterval {
  readonly first: number;
  readonly last: number;
}

/**
 * The intervals in which a joint of the foot is in contact with the floor, although it may slide, by hysteresis
 * thresholding of its speed (as in Canny 1986): an interval lasts while the joint is low and slower than
 * `RELEASE_SPEED`, and it counts if the joint is slower than `CONTACT_SPEED` somewhere in it. A single threshold would
 * split it wherever a slide is a little faster.
 *
 * @param joint index in the skeleton
 */
export function contactIntervals(motion: SolvedMotion, joint: number): ContactInterval[] {
  const { fps, offsets } = motion;
  const { heights, vertical, horizontal } = jointTrack(motion, joint);
  const toe = PARENTS.indexOf(joint);
  const maxHeight = MAX_TOE_HEIGHT - (toe < 0 ? 0 : offsets[toe * 3 + 1]!);
  const speeds = horizontal.map((speed, frame) => {
    const low = Math.max(heights[frame]!, heights[frame + 1]!) < maxHeight;
    return low && vertical[frame]! < VERTICAL_SPEED ? speed : Infinity;
  });
  return runsBelow(speeds, CONTACT_SPEED, RELEASE_SPEED)
    .filter(({ from, to }) => to - from >= MIN_DURATION * fps)
    .map(({ from, to }) => ({ first: from, last: to }));
}
