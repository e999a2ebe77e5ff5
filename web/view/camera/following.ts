import { easing, type View } from './framing';

/** How a camera follows a couple that travels: plain numbers, no camera. */

export interface FollowInput {
  readonly view: View;
  /** Width / height of the picture. */
  readonly aspect: number;
  /** From where the camera last followed to the couple's middle, metres on the floor plan. */
  readonly offset: readonly [x: number, z: number];
  /** From the eye to its target, metres. */
  readonly distance: number;
  /** Distance at which the couple fills the picture as it should, metres. */
  readonly fitDistance: number;
  /** Whether the camera may change its distance. */
  readonly mayZoom: boolean;
}

interface FollowStep {
  /** By how much eye and target move, metres. */
  readonly shift: readonly [x: number, z: number];
  /** The new distance, or null where it stays. */
  readonly distance: number | null;
  /** Whether the camera is not there yet. */
  readonly moving: boolean;
}

/** How far the couple may leave the middle in the orbit view before the camera follows, metres; less in a narrow picture. */
const SLACK = 0.4;
/** Time constants of following by view, of moving back and of coming closer, seconds. */
const FOLLOW_TAU = { orbit: 0.9, follow: 0.35, top: 0.35, side: 0.35 } as const satisfies Record<
  View,
  number
>;
const BACK_TAU = 1;
const CLOSER_TAU = 4;
/** Longest time constant while the couple rests, seconds: the viewer waits for the camera then. */
const RESTING_TAU = 0.4;
/** Offsets (metres) and errors of the distance (share of it) too small to correct, while the couple dances and rests. */
const MIN_OFFSET = { dancing: 5e-4, resting: 0.02 } as const;
const MIN_ZOOM = { dancing: 0.002, resting: 0.01 } as const;
/** Errors of the distance, as a share of it, from which on a camera that does not glide jumps. */
const TOO_CLOSE = 0.08;
const TOO_FAR = -0.25;

const slackOf = (aspect: number): number => SLACK * Math.min(1, aspect);

/**
 * Follows smoothly (exponential smoothing).
 *
 * @param dt seconds since the last frame
 * @param danced whether the couple moved since then
 */
export function followSmoothly(input: FollowInput, dt: number, danced: boolean): FollowStep {
  const { view, aspect, offset, distance, fitDistance, mayZoom } = input;
  const far = Math.hypot(...offset);
  const beyond = view === 'orbit' ? (far > slackOf(aspect) ? 1 - slackOf(aspect) / far : 0) : 1;
  const now = danced ? 'dancing' : 'resting';
  const tau = (dancing: number): number => (danced ? dancing : Math.min(dancing, RESTING_TAU));
  const moves = far * beyond > MIN_OFFSET[now];
  const share = moves ? beyond * easing(dt, tau(FOLLOW_TAU[view])) : 0;
  // Moving back is quick, so that nobody is cut off; coming closer is slow, and waits while they rest.
  const error = fitDistance / distance - 1;
  const zooms = mayZoom && (error > MIN_ZOOM[now] || (error < -0.03 && danced));
  const step = easing(dt, tau(error > 0 ? BACK_TAU : CLOSER_TAU));
  return {
    shift: [offset[0] * share, offset[1] * share],
    distance: zooms ? distance + (fitDistance - distance) * step : null,
    moving: moves || (zooms && error > 0),
  };
}

/** Follows with reduced motion: stands still until the couple has left its place or the picture, then jumps. */
export function followByJumps({ aspect, offset, distance, fitDistance, mayZoom }: FollowInput): FollowStep {
  const error = fitDistance / distance - 1;
  const left = Math.hypot(...offset) > slackOf(aspect);
  const misfit = mayZoom && (error > TOO_CLOSE || error < TOO_FAR);
  return left || misfit
    ? { shift: offset, distance: mayZoom ? fitDistance : null, moving: false }
    : { shift: [0, 0], distance: null, moving: false };
}
