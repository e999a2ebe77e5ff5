import { Vector3 } from 'three';
import type { Framing, Shot, View } from '../../common/framing';
import { followByJumps, followSmoothly, type FollowInput } from './following';
import { fitDistance, type Couple } from './framing';
import { nearestSide, type HeadingPlan } from './heading-plan';
import type { OrbitCamera } from './orbit-camera';

/** What a camera follows at one moment of the dance. */
export interface Dance {
  readonly couple: Couple;
  readonly seconds: number;
  /** Whether the couple has moved since the last frame. */
  readonly danced: boolean;
}

/** Moves a camera along with the couple, in what the person has not taken into their hands. */
export class CoupleFollower {
  /** Whether the person has chosen a distance, which is then kept. */
  ownDistance = false;
  /** Whether the person has turned or panned the camera, which then does not turn by itself. */
  ownHeading = false;
  private plan: HeadingPlan | null = null;
  /** Moment that the camera last turned for, seconds: a new dance at the same moment does not turn it. */
  private turnedFor = NaN;
  /** Where the couple was when the camera last followed; the view that the person panned to stays relative to it. */
  private readonly tracked = new Vector3();

  constructor(private readonly orbit: OrbitCamera) {}

  /** Sets the headings from which both dancers are seen; null for a dancer alone. */
  setPlan(plan: HeadingPlan | null): void {
    this.plan = plan;
  }

  /** The planned heading nearest to `near`, from which both dancers are seen; `near` for a dancer alone. */
  sideHeading(seconds: number, near = this.orbit.shot.heading): number {
    return this.plan ? nearestSide(this.plan(seconds), near) : near;
  }

  /** Whether the camera turns with the couple in this view. */
  turnsIn(view: View): boolean {
    return (view === 'orbit' || view === 'follow') && !this.ownHeading;
  }

  /** Follows from a shot that the page has chosen. */
  startFrom({ target }: Shot): void {
    this.ownDistance = false;
    this.ownHeading = false;
    this.tracked.set(...target);
  }

  /** Follows the couple from now on as `framing` does. */
  followAs({ tracked: [x, z], ownDistance, ownHeading }: Framing, couple: Couple): void {
    this.tracked.set(couple.x + x, 0, couple.z + z);
    this.ownDistance = ownDistance;
    this.ownHeading = ownHeading;
  }

  /** What of a framing the follower knows. */
  framing(couple: Couple): Pick<Framing, 'tracked' | 'ownDistance' | 'ownHeading'> {
    const { tracked, ownDistance, ownHeading } = this;
    return { tracked: [tracked.x - couple.x, tracked.z - couple.z], ownDistance, ownHeading };
  }

  /**
   * Moves the camera to where it is `dt` seconds later; true while it moves.
   *
   * @param held whether the person holds the camera, which then neither turns nor changes its distance by itself
   * @param jumps whether it jumps instead of gliding
   */
  follow(view: View, dt: number, dance: Dance, { held, jumps }: { held: boolean; jumps: boolean }): boolean {
    const { orbit, tracked } = this;
    const { couple, seconds, danced } = dance;
    const { distance: before, heading } = orbit.shot;
    const turns = this.turnsIn(view) && !held && seconds !== this.turnedFor;
    const input: FollowInput = {
      view,
      aspect: orbit.aspect,
      offset: [couple.x - tracked.x, couple.z - tracked.z],
      distance: before,
      fitDistance: fitDistance(couple, orbit.aspect),
      mayZoom: !this.ownDistance && !held && view !== 'top',
      turn: turns ? this.sideHeading(seconds) - heading : 0,
    };
    const { shift, distance, turn, moving } = jumps
      ? followByJumps(input)
      : followSmoothly(input, dt, danced);
    const [x, z] = shift;
    tracked.set(tracked.x + x, tracked.y, tracked.z + z);
    orbit.translate(x, z);
    if (distance !== null) orbit.shot = { ...orbit.shot, distance };
    if (turn !== 0) orbit.turn(turn, tracked);
    else this.turnedFor = seconds;
    return moving;
  }
}
