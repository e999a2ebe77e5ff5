import { footContacts, type FootContacts, RELEASE_SPEED } from '../motion/contact/foot-contacts';
import { FEET } from '../motion/skeleton/skeleton';
import { severity, type Measure, type Scale, worstMoments } from './moments';
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

/** The numbers of the whole dance; without any contact there is nothing to slide and both slides are NaN. */
function footSkating({ inContact, speed }: FootContacts, rule: Rules['contact']): FootSkating {
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

/** Factor over the limit at which a slide has severity 2. */
const BAD_FACTOR = 4;
/** Frames to either side over which a slide is averaged. */
const HALF_WINDOW = 4;

/**
 * The visible slide around every frame, m/s: the largest mean slide of the joints that are in contact for most of a third
 * of a second. Shorter contacts, as in a low step or where a foot brushes the floor, are not visible as slides. NaN
 * without contact.
 */
export function visibleSlide({ inContact, speed }: FootContacts): Float32Array {
  const steps = inContact.length / FEET.length;
  const largest = new Float32Array(steps + 1).fill(NaN);
  FEET.forEach((_, foot) => {
    let standing = 0;
    let slide = 0;
    const count = (frame: number, sign: 1 | -1): void => {
      const sample = frame * FEET.length + foot;
      if (frame < 0 || frame >= steps || !inContact[sample] || speed[sample]! > RELEASE_SPEED) return;
      standing += sign;
      slide += sign * speed[sample]!;
    };
    for (let frame = -HALF_WINDOW; frame < steps; frame++) {
      count(frame + HALF_WINDOW, 1);
      count(frame - HALF_WINDOW - 1, -1);
      if (frame < 0 || standing <= HALF_WINDOW) continue;
      const mean = slide / standing;
      if (!(largest[frame]! >= mean)) largest[frame] = mean;
    }
  });
  return largest;
}

/** Foot skating of the reactor. */
export function measureFeet(duet: Duet, rules: Rules): Measure<FootSkating> {
  const rule = rules.contact;
  const found = footContacts({ ...duet, positions: duet.reactor }, rule);
  const scale: Scale = { fine: 0, limit: rule.slide_speed, bad: BAD_FACTOR * rule.slide_speed };
  const slides = visibleSlide(found);
  const row = slides.map((slide) => severity(slide, scale));
  return {
    whole: footSkating(found, rule),
    rows: [row],
    worst: worstMoments(row, duet.fps, 'slide', (frame) => slides[frame]!),
  };
}
