import type { Framing, Shot, View } from '../../common/framing';
import { headingOf } from '../../motion/skeleton/heading';

/** Measures the couple and chooses shots of it: plain numbers, no camera. */

/** Place and size of what has to be in the picture. */
export interface Couple {
  /** Middle between the roots, metres. */
  readonly x: number;
  readonly z: number;
  /** Largest distance of a joint from the middle, on the floor plan, metres. */
  readonly radius: number;
  /** Highest joint, metres. */
  readonly height: number;
  /** Distance of the eye from the middle at which every joint is between the upper and the lower edge, from any side, metres. */
  readonly uprightDistance: number;
  /** Heading from which both are seen side by side, the leader on the right. */
  readonly sideHeading: number;
}

export const FIELD_OF_VIEW = 26;
const TARGET_HEIGHT = 0.84;
const EYE_HEIGHT = 1.3;
/** Distance from which a couple of ordinary height fills 73 % of the picture. */
const BASE_DISTANCE = 5.05;
/** From farther away the lit part of the floor is too small to stand on, metres. */
export const MAX_DISTANCE = 10;
/** Room beside the outermost and above the highest joint: half a hand, a skull, and air, metres. */
const MARGIN = 0.22;
const HEADROOM = 0.22;
/** Room below the lowest joint: a sole and air, metres. */
const FOOTROOM = 0.08;
/** By how much the eye looks down in views from the side, as a share of the distance. */
const DOWN = (EYE_HEIGHT - TARGET_HEIGHT) / BASE_DISTANCE;
/** Half the height of the picture, at a distance of 1. */
const TANGENT = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
/** Size of a pixel on a dancer from which on the low level of detail looks like the full one, metres. */
const LOW_DETAIL_PIXEL = 0.004;

/** Heading from which a dancer alone is seen, from their front: a three-quarter view, radians. */
const THREE_QUARTERS = 0.5;

/**
 * Measures the dancers on the stage.
 *
 * @param dancers joint positions (22 x 3, metres), the leader first.
 * @param beside joints of other dancers that have to be in the picture too
 */
export function measureCouple(
  dancers: readonly Float32Array[],
  beside: readonly Float32Array[] = [],
): Couple {
  const [first, second] = dancers;
  if (first === undefined) return { x: 0, z: 0, radius: 0.5, height: 0, uprightDistance: 0, sideHeading: 0 };
  let [x, z, radius, height, uprightDistance] = [0, 0, 0, 0, 0];
  for (const joints of dancers) {
    x += joints[0]! / dancers.length;
    z += joints[2]! / dancers.length;
  }
  for (const joints of [...dancers, ...beside])
    for (let j = 0; j < joints.length; j += 3) {
      const [away, above] = [Math.hypot(joints[j]! - x, joints[j + 2]! - z), joints[j + 1]!];
      radius = Math.max(radius, away);
      height = Math.max(height, above);
      // Whoever is nearer to the eye than the middle looks taller, and their feet are seen farther down.
      const below = TARGET_HEIGHT + FOOTROOM - above + away * DOWN;
      const half = Math.max(above + HEADROOM - TARGET_HEIGHT, below);
      uprightDistance = Math.max(uprightDistance, half / TANGENT + away);
    }
  const sideHeading =
    second === undefined
      ? headingOf(first) + THREE_QUARTERS
      : Math.atan2(second[2]! - first[2]!, first[0]! - second[0]!);
  return { x, z, radius, height, uprightDistance, sideHeading };
}

/** Distance at which a couple fills the picture as it should, from any side, or the greatest that the camera takes. */
export function fitDistance({ radius, uprightDistance }: Couple, aspect: number): number {
  const perspective = Math.hypot(1, 1 / (TANGENT * aspect));
  return Math.min(MAX_DISTANCE, Math.max(BASE_DISTANCE, uprightDistance, (radius + MARGIN) * perspective));
}

/**
 * Whether both dancers are so small in the picture that a low level of detail is enough.
 *
 * @param eye where the camera is, metres
 * @param height of the picture, in pixels of the screen
 */
export function isFar(
  eye: { readonly x: number; readonly y: number; readonly z: number },
  couple: Couple,
  height: number,
): boolean {
  const nearest = Math.hypot(eye.x - couple.x, eye.y - TARGET_HEIGHT, eye.z - couple.z) - couple.radius;
  return (2 * nearest * TANGENT) / height > LOW_DETAIL_PIXEL;
}

/** The shot each view begins with. `heading` is where the eye stands now, for views that keep it. */
export function shotOf(view: View, couple: Couple, aspect: number, heading: number): Shot {
  const distance = fitDistance(couple, aspect);
  const target = [couple.x, TARGET_HEIGHT, couple.z] as const;
  switch (view) {
    case 'orbit':
    case 'follow':
      return {
        target,
        distance,
        heading,
        elevation: Math.asin(DOWN),
      };
    case 'side':
      return { target, distance, heading: couple.sideHeading, elevation: 0.02 };
    case 'top': {
      const above = (couple.radius + 2 * MARGIN) / (TANGENT * Math.min(1, aspect));
      return {
        target: [couple.x, 0, couple.z],
        distance: Math.max(above + couple.height, BASE_DISTANCE),
        heading,
        // Straight down has no heading; slightly less keeps it.
        elevation: Math.PI / 2 - 0.001,
      };
    }
  }
}

/**
 * The shot that frames this couple as `framing` does in a picture of another shape. A distance that the person
 * chose stays, unless the picture is narrower: then as much is seen to the sides.
 */
export function reframed(framing: Framing, couple: Couple, aspect: number): Shot {
  const { view, shot, ownDistance } = framing;
  const [x, y, z] = shot.target;
  const target = [couple.x + x, y, couple.z + z] as const;
  const within = (shape: number): number => shotOf(view, couple, shape, shot.heading).distance;
  if (view === 'top') {
    return { ...shot, target, distance: (shot.distance * within(aspect)) / within(framing.aspect) };
  }
  const distance = ownDistance ? shot.distance * Math.max(1, framing.aspect / aspect) : within(aspect);
  return { ...shot, target, distance };
}

/** The same angle modulo a full turn, within half a turn of `near`. */
export function nearestAngle(angle: number, near: number): number {
  return angle - 2 * Math.PI * Math.round((angle - near) / (2 * Math.PI));
}

/** Share of the way to its goal that an exponentially smoothed value goes in `dt` seconds with time constant `tau`. */
export const easing = (dt: number, tau: number): number => 1 - Math.exp(-dt / tau);
