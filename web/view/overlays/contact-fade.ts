import type { SolvedMotion } from '../../motion/skeleton/clip';
import { contactIntervals, type ContactInterval } from '../../motion/contact/foot-contacts';
import { J } from '../../motion/skeleton/skeleton';

/** Seconds in which a contact appears when a foot comes to stand and goes when it has left. */
const COMES = 0.08;
const GOES = 0.2;

/** When the left and when the right toes stand. */
export type Steps = readonly [left: readonly ContactInterval[], right: readonly ContactInterval[]];

export const stepsOf = (motion: SolvedMotion): Steps => [
  contactIntervals(motion, J.left_foot),
  contactIntervals(motion, J.right_foot),
];

/** How much of a contact is to be seen at a moment, 0 to 1: it comes with the step and lingers after it. */
export function contactAt(intervals: readonly ContactInterval[], fps: number, seconds: number): number {
  let most = 0;
  for (const { first, last } of intervals) {
    const came = (seconds - first / fps) / COMES;
    if (came < 0) break;
    const gone = (seconds - last / fps) / GOES;
    most = Math.max(most, Math.min(1, came, 1 - gone));
  }
  return most;
}
