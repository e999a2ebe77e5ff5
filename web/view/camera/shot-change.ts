import type { Shot } from '../../common/framing';

/** Change of the distance from which on a gesture counts as zooming, metres. */
const ZOOMED = 0.01;
/** Change of an angle (radians) or of the target (metres) from which on it counts as turning or panning. */
const DRAGGED = 0.005;

/** Seconds that a move from one shot to another takes. */
const MOVE_SECONDS = 0.6;

/** Cubic ease-in and ease-out of 0 to 1. */
const easeInOut = (t: number): number => (t < 0.5 ? 4 * t ** 3 : 1 - (2 - 2 * t) ** 3 / 2);

/** The shot on the way from one to another, when `done` of the time (0 to 1) is over. */
export function shotBetween(from: Shot, to: Shot, done: number): Shot {
  const t = easeInOut(done);
  const between = (a: number, b: number): number => a + (b - a) * t;
  return {
    target: [
      between(from.target[0], to.target[0]),
      between(from.target[1], to.target[1]),
      between(from.target[2], to.target[2]),
    ],
    distance: between(from.distance, to.distance),
    heading: between(from.heading, to.heading),
    elevation: between(from.elevation, to.elevation),
  };
}

/** A move of the camera to another shot. */
export class ShotMove {
  private done = 0;

  constructor(
    private readonly from: Shot,
    readonly to: Shot,
  ) {}

  get ended(): boolean {
    return this.done === 1;
  }

  /** The shot `dt` seconds later. */
  advance(dt: number): Shot {
    this.done = Math.min(1, this.done + dt / MOVE_SECONDS);
    return shotBetween(this.from, this.to, this.done);
  }
}

/** What a gesture did: zoomed, or dragged the camera, which turns or pans it. */
export function gestureBetween(before: Shot, after: Shot): { zoomed: boolean; dragged: boolean } {
  const zoomed = Math.abs(after.distance - before.distance) > ZOOMED;
  const turned = Math.hypot(after.heading - before.heading, after.elevation - before.elevation) > DRAGGED;
  const moved = Math.hypot(...after.target.map((value, axis) => value - before.target[axis]!)) > DRAGGED;
  // Zooming to the pointer moves the target too.
  return { zoomed, dragged: turned || (moved && !zoomed) };
}
