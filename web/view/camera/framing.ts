import { headingOf } from '../../motion/skeleton/heading';

/** Where the couple is and from where it is seen best: plain numbers, no camera. */

export type View = 'orbit' | 'follow' | 'top' | 'side';

/** Metres and radians. The eye stands at target + distance in direction (heading, elevation). */
export interface Shot {
  readonly target: readonly [x: number, y: number, z: number];
  readonly distance: number;
  /** About y; 0 puts the eye on +z. */
  readonly heading: number;
  /** Above the horizon. */
  readonly elevation: number;
}

/** What has to be in the picture. */
export interface Couple {
  /** Middle between the roots, metres. */
  readonly x: number;
  readonly z: number;
  /** Largest distance of a joint from the middle, on the floor plan, metres. */
  readonly reach: number;
  /** Highest joint, metres. */
  readonly height: number;
  /** Heading from which both are seen side by side, the leader on the right. */
  readonly square: number;
}

/** How a couple is seen, apart from where it is: what another picture needs to be framed alike. */
export interface Framing {
  readonly view: View;
  /** Target as metres from the couple's middle, on the floor plan. */
  readonly shot: Shot;
  /** Metres from the couple's middle to where the camera last went along with it. */
  readonly tracked: readonly [x: number, z: number];
  /** The person has chosen the distance. */
  readonly ownDistance: boolean;
  /** Width / height of the picture. */
  readonly aspect: number;
}

export const FIELD_OF_VIEW = 26;
const TARGET_HEIGHT = 0.84;
const EYE_HEIGHT = 1.3;
/** Distance from which a couple of ordinary height fills 73 % of the picture. */
const BASE_DISTANCE = 5.05;
/** Room beside the outermost and above the highest joint: half a hand and air, metres. */
const MARGIN = 0.22;
const HEADROOM = 0.12;
/** A pixel that covers this much of a dancer shows no more than the light triangles do, metres. */
const LIGHT_PIXEL = 0.004;

/** How far to the side of straight ahead somebody alone is seen from: three-quarters from the front, radians. */
const THREE_QUARTERS = 0.5;

/**
 * Measures whoever is on the stage.
 *
 * @param dancers joint positions (22 x 3, metres), the leader first.
 * @param beside joints of others who have to be in the picture too, without being the couple
 */
export function measureCouple(
  dancers: readonly Float32Array[],
  beside: readonly Float32Array[] = [],
): Couple {
  const [first, second] = dancers;
  if (first === undefined) return { x: 0, z: 0, reach: 0.5, height: 0, square: 0 };
  let [x, z, reach, height] = [0, 0, 0, 0];
  for (const joints of dancers) {
    x += joints[0]! / dancers.length;
    z += joints[2]! / dancers.length;
  }
  for (const joints of [...dancers, ...beside])
    for (let j = 0; j < joints.length; j += 3) {
      reach = Math.max(reach, Math.hypot(joints[j]! - x, joints[j + 2]! - z));
      height = Math.max(height, joints[j + 1]!);
    }
  const square =
    second === undefined
      ? headingOf(first) + THREE_QUARTERS
      : Math.atan2(second[2]! - first[2]!, first[0]! - second[0]!);
  return { x, z, reach, height, square };
}

/** Distance at which a couple of this reach and height fills the picture as it should. */
export function fitDistance(couple: Pick<Couple, 'reach' | 'height'>, aspect: number): number {
  const tangent = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
  const tall = (couple.height + HEADROOM - TARGET_HEIGHT) / tangent;
  const wide = (couple.reach + MARGIN) / (tangent * aspect);
  return Math.max(BASE_DISTANCE, tall, wide);
}

/**
 * Whether a dancer is so small in the picture that light bodies look like full ones, even the one nearer to the eye.
 *
 * @param eye where the camera is, metres
 * @param height of the picture, in pixels of the screen
 */
export function isFar(
  eye: { readonly x: number; readonly y: number; readonly z: number },
  couple: Couple,
  height: number,
): boolean {
  const away = Math.hypot(eye.x - couple.x, eye.y - TARGET_HEIGHT, eye.z - couple.z) - couple.reach;
  const tangent = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
  return (2 * away * tangent) / height > LIGHT_PIXEL;
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
        elevation: Math.asin((EYE_HEIGHT - TARGET_HEIGHT) / BASE_DISTANCE),
      };
    case 'side':
      return { target, distance, heading: couple.square, elevation: 0.02 };
    case 'top': {
      const tangent = Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
      const above = (couple.reach + 2 * MARGIN) / (tangent * Math.min(1, aspect));
      return {
        target: [couple.x, 0, couple.z],
        distance: Math.max(above + couple.height, BASE_DISTANCE),
        heading,
        // Straight down has no heading; a hair's breadth less keeps it.
        elevation: Math.PI / 2 - 0.001,
      };
    }
  }
}

/**
 * The shot that frames this couple as `framing` does in a picture of another shape. A distance chosen by hand stays,
 * unless the picture is narrower: then as much is seen to the sides.
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

/** The same angle, within half a turn of `near`. */
export function nearestTurn(angle: number, near: number): number {
  return angle - 2 * Math.PI * Math.round((angle - near) / (2 * Math.PI));
}

/** Share of the way to a goal that an eased value covers in `dt` seconds with time constant `tau`. */
export const easing = (dt: number, tau: number): number => 1 - Math.exp(-dt / tau);
