import { LEAVE } from '../motion/planted';
import { FEET, JOINT_COUNT } from '../motion/skeleton';
import { percentile } from '../motion/statistics';
import { concern, type Measure, type Scale, worstMoments } from './moments';
import type { Duet, Rules } from './rules';

/** Foot skating over the whole dance: `foot_skating` of training/evaluation/metrics/contact.py. */
export interface FootSkating {
  /** Share of contact samples (a joint of a foot in a frame) that slide. */
  readonly skateShare: number;
  /** Mean slide in contact, m/s. */
  readonly slideSpeed: number;
  /** Share of all samples in contact. */
  readonly contactShare: number;
}

/** Contact and horizontal speed in m/s of ankles and feet between frames, (frames - 1) x 4. */
export interface Contacts {
  readonly planted: Uint8Array;
  readonly speed: Float64Array;
}

/**
 * Which joints of the feet stand, and how fast they move over the floor: `contacts` of training/evaluation/metrics/contact.py.
 * Measured against each joint's own low heights, so neither the floor nor the foot's thickness matters.
 */
export function contacts(
  positions: Float32Array,
  frames: number,
  fps: number,
  rule: Rules['contact'],
): Contacts {
  const steps = Math.max(0, frames - 1);
  const planted = new Uint8Array(steps * FEET.length);
  const speed = new Float64Array(steps * FEET.length);
  FEET.forEach((joint, foot) => {
    const at = (frame: number, axis: number): number => positions[(frame * JOINT_COUNT + joint) * 3 + axis]!;
    const heights = Float64Array.from({ length: frames }, (_, frame) => at(frame, 1));
    const low = percentile(heights, rule.percentile) + rule.height;
    for (let frame = 0; frame < steps; frame++) {
      const step = (axis: number): number => (at(frame + 1, axis) - at(frame, axis)) * fps;
      const sample = frame * FEET.length + foot;
      planted[sample] = Number(heights[frame]! < low && Math.abs(step(1)) < rule.vertical_speed);
      speed[sample] = Math.hypot(step(0), step(2));
    }
  });
  return { planted, speed };
}

/** The numbers of the whole dance; without any contact there is nothing to slide and both slides are NaN. */
export function footSkating({ planted, speed }: Contacts, rule: Rules['contact']): FootSkating {
  let standing = 0;
  let skating = 0;
  let slide = 0;
  planted.forEach((stands, sample) => {
    if (!stands) return;
    standing++;
    slide += speed[sample]!;
    if (speed[sample]! > rule.slide_speed) skating++;
  });
  return {
    skateShare: skating / standing,
    slideSpeed: slide / standing,
    contactShare: standing / planted.length,
  };
}

/** A foot that slides this much faster than it may is a clear fault. */
const BAD = 4;
/** Frames to either side over which a slide is felt. */
const AROUND = 4;

/**
 * The slide that is seen around every frame, m/s: of the joints that stand for most of a third of a second the one that
 * slides most, on average. Contact alone says too much for that: a low step or a foot that brushes the floor for a
 * frame or two is no slide to the eye. NaN where nothing stands.
 */
export function seenSlide({ planted, speed }: Contacts): Float32Array {
  const steps = planted.length / FEET.length;
  const seen = new Float32Array(steps + 1).fill(NaN);
  FEET.forEach((_, foot) => {
    let standing = 0;
    let slide = 0;
    const count = (frame: number, sign: 1 | -1): void => {
      const sample = frame * FEET.length + foot;
      if (frame < 0 || frame >= steps || !planted[sample] || speed[sample]! > LEAVE) return;
      standing += sign;
      slide += sign * speed[sample]!;
    };
    for (let frame = -AROUND; frame < steps; frame++) {
      count(frame + AROUND, 1);
      count(frame - AROUND - 1, -1);
      if (frame < 0 || standing <= AROUND) continue;
      const mean = slide / standing;
      if (!(seen[frame]! >= mean)) seen[frame] = mean;
    }
  });
  return seen;
}

/** Foot skating of the reactor. */
export function measureFeet(duet: Duet, rules: Rules): Measure<FootSkating> {
  const rule = rules.contact;
  const found = contacts(duet.reactor, duet.frames, duet.fps, rule);
  const scale: Scale = { fine: 0, limit: rule.slide_speed, bad: BAD * rule.slide_speed };
  const seen = seenSlide(found);
  const row = seen.map((slide) => concern(slide, scale));
  return {
    whole: footSkating(found, rule),
    rows: [row],
    worst: worstMoments(row, duet.fps, 'slide', (frame) => seen[frame]!),
  };
}
