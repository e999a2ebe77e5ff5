import type { View } from '../../common/framing';
import { easing } from './framing';

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
  /** Angle to the heading from which both dancers are seen, radians; 0 where the camera may not turn. */
  readonly turn: number;
}

interface FollowStep {
  /** By how much eye and target move, metres. */
  readonly shift: readonly [x: number, z: number];
  /** The new distance, or null where it stays. */
  readonly distance: number | null;
  /** By how much the camera turns about the couple, radians. */
  readonly turn: number;
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
const BACK_TAU = 0.6;
const CLOSER_TAU = 4;
/** Time constant of turning, seconds, and the fastest turn, radians a second. */
const TURN_TAU = 0.2;
const MAX_TURN = 0.9;
/** A turn too small to be made, radians. */
const MIN_TURN = 0.003;
/** In the orbit view the camera follows twice as fast where the couple is beyond the slack by this share of it. */
const HURRY = 0.6;
const MAX_HURRY = 4;
/** Longest time constant while the couple rests, seconds: the viewer waits for the camera then. */
const RESTING_TAU = 0.4;
/** Offsets (metres) and errors of the distance (share of it) too small to correct, while the couple dances and rests. */
const MIN_OFFSET = { dancing: 5e-4, resting: 0.02 } as const;
const MIN_ZOOM = { dancing: 0.002, resting: 0.01 } as const;
/** Errors of the distance, as a share of it, from which on a camera that does not glide jumps. */
const TOO_CLOSE = 0.08;
const TOO_FAR = -0.25;
/** Angle from which on a camera that does not glide jumps to where both are seen, radians. */
const TOO_TURNED = 0.8;

const slackOf = (aspect: number): number => SLACK * Math.min(1, aspect) ** 2;

/**
 * Follows smoothly (exponential smoothing).
 *
 * @param dt seconds since the last frame
 * @param danced whether the couple moved since then
 */
export function followSmoothly(input: FollowInput, dt: number, danced: boolean): FollowStep {
  const { view, aspect, offset, distance, fitDistance, mayZoom } = input;
  const far = Math.hypot(...offset);
  const slack = view === 'orbit' ? slackOf(aspect) : 0;
  const beyond = far > slack ? 1 - slack / far : 0;
  // Who leaves fast is followed fast, so that no head leaves the picture.
  const hurry = slack === 0 ? 1 : Math.min(MAX_HURRY, 1 + ((far * beyond) / (HURRY * slack)) ** 2);
  const now = danced ? 'dancing' : 'resting';
  const tau = (dancing: number): number => (danced ? dancing : Math.min(dancing, RESTING_TAU));
  const moves = far * beyond > MIN_OFFSET[now];
  const share = moves ? beyond * easing(dt, tau(FOLLOW_TAU[view] / hurry)) : 0;
  // Moving back is quick, so that nobody is cut off; coming closer is slow, and waits while they rest.
  const error = fitDistance / distance - 1;
  const zooms = mayZoom && (error > MIN_ZOOM[now] || (error < -0.03 && danced));
  const step = easing(dt, tau(error > 0 ? BACK_TAU : CLOSER_TAU));
  const turns = Math.abs(input.turn) > MIN_TURN;
  const turn = Math.min(Math.abs(input.turn) * easing(dt, TURN_TAU), MAX_TURN * dt) * Math.sign(input.turn);
  return {
    shift: [offset[0] * share, offset[1] * share],
    distance: zooms ? distance + (fitDistance - distance) * step : null,
    turn: turns ? turn : 0,
    moving: moves || turns || (zooms && error > 0),
  };
}

/**
 * Follows with reduced motion: stands still until the couple has left its place or the picture or one dancer is about to
 * hide the other, then jumps.
 */
export function followByJumps(input: FollowInput): FollowStep {
  const { aspect, offset, distance, fitDistance, mayZoom, turn } = input;
  const error = fitDistance / distance - 1;
  const left = Math.hypot(...offset) > slackOf(aspect);
  const misfit = mayZoom && (error > TOO_CLOSE || error < TOO_FAR);
  return left || misfit || Math.abs(turn) > TOO_TURNED
    ? { shift: offset, distance: mayZoom ? fitDistance : null, turn, moving: false }
    : { shift: [0, 0], distance: null, turn: 0, moving: false };
}
