import { FEET } from '../../motion/skeleton/skeleton';
import type { Shot } from '../../common/framing';
import { shotOf, type Couple } from './framing';

/** What a camera can show of a moment: the feet of the dancer that was made, both trunks, or the whole couple. */
export type Detail = 'feet' | 'trunks' | 'couple';

/** Distances at which the feet and the trunks fill the picture, metres, and the heights that are looked at. */
const FEET_DISTANCE = 2.6;
const FEET_HEIGHT = 0.2;
const TRUNK_DISTANCE = 3.4;
const TRUNK_HEIGHT = 1;
/** How far the camera looks down on them, radians. */
const FEET_ELEVATION = 0.22;
const TRUNK_ELEVATION = 0.14;

/**
 * The shot that shows a detail.
 *
 * @param made 22 x 3 joints of the dancer that was made, metres
 * @param heading from which both dancers are seen, radians
 */
export function focusShot(
  detail: Detail,
  made: Float32Array,
  couple: Couple,
  aspect: number,
  heading: number,
): Shot {
  const narrow = 1 / Math.min(1, aspect);
  switch (detail) {
    case 'feet': {
      const mean = (axis: number): number =>
        FEET.reduce((sum, joint) => sum + made[joint * 3 + axis]!, 0) / FEET.length;
      return {
        target: [mean(0), FEET_HEIGHT, mean(2)],
        distance: FEET_DISTANCE * narrow,
        heading,
        elevation: FEET_ELEVATION,
      };
    }
    case 'trunks':
      return {
        target: [couple.x, TRUNK_HEIGHT, couple.z],
        distance: TRUNK_DISTANCE * narrow,
        heading,
        elevation: TRUNK_ELEVATION,
      };
    case 'couple':
      return shotOf('orbit', couple, aspect, heading);
  }
}
