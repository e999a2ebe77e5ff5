/** How the camera sees the couple: plain numbers, which the stage draws by and a visit stores. */

export const VIEWS = ['orbit', 'follow', 'top', 'side'] as const;
export type View = (typeof VIEWS)[number];

/** Placement of the camera, metres and radians. The eye is at target + distance in direction (heading, elevation). */
export interface Shot {
  readonly target: readonly [x: number, y: number, z: number];
  readonly distance: number;
  /** About y; 0 puts the eye on +z. */
  readonly heading: number;
  /** Above the horizon. */
  readonly elevation: number;
}

/** How a couple is framed, relative to where it is: all that another picture needs to be framed alike. */
export interface Framing {
  readonly view: View;
  /** Target as metres from the couple's middle, on the floor plan. */
  readonly shot: Shot;
  /** Metres from the couple's middle to where the camera last went along with it. */
  readonly tracked: readonly [x: number, z: number];
  /** The person has chosen the distance. */
  readonly ownDistance: boolean;
  /** The person has turned the camera, which then does not turn by itself. */
  readonly ownHeading: boolean;
  /** Width / height of the picture. */
  readonly aspect: number;
}
