import { easing, type View } from './framing';

/** How a camera goes along with a couple that travels: plain numbers, no camera. */

export interface Seen {
  readonly view: View;
  /** Width / height of the picture. */
  readonly aspect: number;
  /** From where the camera last went along to the couple's middle, metres on the floor plan. */
  readonly away: readonly [x: number, z: number];
  /** From the eye to its target, metres. */
  readonly distance: number;
  /** Distance at which the couple fills the picture as it should, metres. */
  readonly goal: number;
  /** Whether the distance is the camera's to choose. */
  readonly free: boolean;
}

export interface Following {
  /** By how much eye and target move, metres. */
  readonly by: readonly [x: number, z: number];
  /** The new distance, or null where it stays. */
  readonly distance: number | null;
  /** Whether there is more to come. */
  readonly moving: boolean;
}

/** How far the couple may stray in the orbit view before the camera goes along, metres; less in a narrow picture. */
const SLACK = 0.4;
const TAU = { orbit: 0.9, follow: 0.35, top: 0.35, side: 0.35 } as const satisfies Record<View, number>;
const BACK_TAU = 1;
/** While they rest, whoever looks waits for the camera: it arrives sooner. */
const RESTING_TAU = 0.4;
const CLOSER_TAU = 4;
/** What is left to go, in metres and as a share of the distance, is left while they dance and while they rest. */
const STILL = { dancing: 5e-4, resting: 0.02 } as const;
const FIT = { dancing: 0.002, resting: 0.01 } as const;
/** How much too close or too far a camera that does not glide may stand before it stands anew. */
const TOO_CLOSE = 0.08;
const TOO_FAR = -0.25;

const slackOf = (aspect: number): number => SLACK * Math.min(1, aspect);

/**
 * Eases along.
 *
 * @param dt seconds since the last picture
 * @param danced whether the couple moved since then
 */
export function glideAlong(seen: Seen, dt: number, danced: boolean): Following {
  const { view, aspect, distance, goal, free } = seen;
  const far = Math.hypot(...seen.away);
  const beyond = view === 'orbit' ? (far > slackOf(aspect) ? 1 - slackOf(aspect) / far : 0) : 1;
  const now = danced ? 'dancing' : 'resting';
  const tau = (dancing: number): number => (danced ? dancing : Math.min(dancing, RESTING_TAU));
  const going = far * beyond > STILL[now];
  const share = going ? beyond * easing(dt, tau(TAU[view])) : 0;
  // Stepping back is quick, nobody may be cut off; coming closer again takes its time, and waits while they rest.
  const off = goal / distance - 1;
  const wanted = free && (off > FIT[now] || (off < -0.03 && danced));
  return {
    by: [seen.away[0] * share, seen.away[1] * share],
    distance: wanted ? distance + (goal - distance) * easing(dt, tau(off > 0 ? BACK_TAU : CLOSER_TAU)) : null,
    moving: going || (wanted && off > 0),
  };
}

/** For who wants no movement but the dance: stands still until the couple has left its place, then stands anew. */
export function cutAlong({ aspect, away, distance, goal, free }: Seen): Following {
  const off = goal / distance - 1;
  const left = Math.hypot(...away) > slackOf(aspect);
  const misfit = free && (off > TOO_CLOSE || off < TOO_FAR);
  return left || misfit
    ? { by: away, distance: free ? goal : null, moving: false }
    : { by: [0, 0], distance: null, moving: false };
}
