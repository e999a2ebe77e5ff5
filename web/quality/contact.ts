import { footContacts, type FootContacts, RELEASE_SPEED } from '../motion/contact/foot-contacts';
import { FEET } from '../motion/skeleton/skeleton';
import { concern, type Measure, type Scale, worstMoments } from './moments';
import type { Duet, Rules } from './rules';

/** Foot skating over the whole dance: `foot_skating` of training/metrics/contact.py. */
export interface FootSkating {
  /** Share of contact samples (a joint of a foot in a frame) that slide. */
  readonly skateShare: number;
  /** Mean slide in contact, m/s. */
  readonly slideSpeed: number;
  /** Share of all samples in contact. */
  readonly contactShare: number;
}

/** The numbers of the whole dance; without any contact there is nothing to slide and both slides are NaN. */
export function footSkating({ inContact, speed }: FootContacts, rule: Rules['contact']): FootSkating {
  let standing = 0;
  let skating = 0;
  let slide = 0;
  inContact.forEach((touches, sample) => {
    if (!touches) return;
    standing++;
    slide += speed[sample]!;
    if (speed[sample]! > rule.slide_speed) skating++;
  });
  return {
    skateShare: skating / standing,
    slideSpeed: slide / standing,
    contactShare: standing / inContact.length,
  };
}

/** A foot that slides this many times faster than it may is a clear fault. */
const BAD = 4;
/** Frames to either side over which a slide is averaged. */
const AROUND = 4;

/**
 * The visible slide around every frame, m/s: of the joints that stand for most of a third of a second the one that
 * slides most, on average. Contact alone says too much for that: a low step or a foot that brushes the floor for a
 * frame or two is no slide to the eye. NaN where nothing stands.
 */
export function visibleSlide({ inContact, speed }: FootContacts): Float32Array {
  const steps = inContact.length / FEET.length;
  const seen = new Float32Array(steps + 1).fill(NaN);
  FEET.forEach((_, foot) => {
    let standing = 0;
    let slide = 0;
    const count = (frame: number, sign: 1 | -1): void => {
      const sample = frame * FEET.length + foot;
      if (frame < 0 || frame >= steps || !inContact[sample] || speed[sample]! > RELEASE_SPEED) return;
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
  const found = footContacts({ ...duet, positions: duet.reactor }, rule);
  const scale: Scale = { fine: 0, limit: rule.slide_speed, bad: BAD * rule.slide_speed };
  const slides = visibleSlide(found);
  const row = slides.map((slide) => concern(slide, scale));
  return {
    whole: footSkating(found, rule),
    rows: [row],
    worst: worstMoments(row, duet.fps, 'slide', (frame) => slides[frame]!),
  };
}
