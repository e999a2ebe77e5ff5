import { type BeatAlignment, measureBeats } from './beats';
import { type FootSkating, measureFeet } from './contact';
import type { Measure } from './moments';
import { type Closeness, measureCloseness } from './penetration';
import type { Duet, Rules } from './rules';
import { measureSeams, type SeamJitter } from './seams';

/** Everything that is measured of a dance. */
export interface Report {
  readonly feet: Measure<FootSkating>;
  readonly closeness: Measure<Closeness>;
  readonly beats: Measure<BeatAlignment>;
  readonly seams: Measure<SeamJitter>;
}

/** Measures a dance. Pure; a dance of three minutes takes a few tenths of a second. */
export function measure(duet: Duet, rules: Rules): Report {
  return {
    feet: measureFeet(duet, rules),
    closeness: measureCloseness(duet, rules),
    beats: measureBeats(duet, rules),
    seams: measureSeams(duet, rules),
  };
}
