import type { SolvedMotion } from '../../motion/skeleton/clip';
import { contactIntervals, type ContactInterval } from '../../motion/contact/foot-contacts';
import { J } from '../../motion/skeleton/skeleton';

/** Seconds in which a contact fades in when it begins, and fades out after its end. */
const FADE_IN = 0.08;
const FADE_OUT = 0.2;

/** Contacts of the left and of the right toes with the floor, in frames. */
export type FootContacts = readonly [left: readonly ContactInterval[], right: readonly ContactInterval[]];

export const footContactsOf = (motion: SolvedMotion): FootContacts => [
  contactIntervals(motion, J.left_foot),
  contactIntervals(motion, J.right_foot),
];

/** Opacity of a foot's contact ring at a moment, 0 to 1. `contacts` are in frames at `fps`. */
export function contactOpacity(contacts: readonly ContactInterval[], fps: number, seconds: number): number {
  let opacity = 0;
  for (const { first, last } of contacts) {
    const fadedIn = (seconds - first / fps) / FADE_IN;
    if (fadedIn < 0) break;
    const fadedOut = (seconds - last / fps) / FADE_OUT;
    opacity = Math.max(opacity, Math.min(1, fadedIn, 1 - fadedOut));
  }
  return opacity;
}
