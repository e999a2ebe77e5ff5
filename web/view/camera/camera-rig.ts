import type { PerspectiveCamera } from 'three';
import type { Framing, Shot, View } from '../../common/framing';
import { CoupleFollower, type Dance } from './couple-follower';
import { focusShot, type Detail } from './focus';
import { measureCouple, nearestAngle, reframed, shotOf, type Couple } from './framing';
import type { HeadingPlan } from './heading-plan';
import { OrbitCamera, type Covered } from './orbit-camera';
import { gestureBetween, ShotMove } from './shot-change';

/** The camera of the stage: its views, moves between them, the person's gestures, and following the couple. */
export class CameraRig {
  private readonly orbit: OrbitCamera;
  private readonly follower: CoupleFollower;
  private view: View = 'orbit';
  private move: ShotMove | null = null;
  /** Whether the person has moved the camera. */
  private userMoved = false;
  /** How the couple was framed before the camera showed a detail; null while it shows none. */
  private beforeFocus: Framing | null = null;
  /** Shot when the gesture that is going on began. */
  private gestureStart: Shot | null = null;

  /**
   * @param surface element that takes the pointer.
   * @param onChange called when the person moves the camera or a move begins.
   * @param reducedMotion the person's preference, with which the camera jumps; null for pictures that leave the page
   */
  constructor(
    surface: HTMLElement,
    private readonly onChange: () => void,
    private readonly reducedMotion: MediaQueryList | null,
  ) {
    this.orbit = new OrbitCamera(surface);
    this.orbit.shot = shotOf(this.view, measureCouple([]), this.orbit.aspect, 0);
    this.follower = new CoupleFollower(this.orbit);
    this.applyPreference();
    reducedMotion?.addEventListener('change', this.applyPreference);
    const { controls } = this.orbit;
    controls.addEventListener('change', onChange);
    controls.addEventListener('start', () => this.beginGesture());
    controls.addEventListener('end', () => this.endGesture());
  }

  get camera(): PerspectiveCamera {
    return this.orbit.camera;
  }

  /** Where the eye stands around the target, radians about y. */
  get heading(): number {
    return this.orbit.shot.heading;
  }

  /** Whether the camera jumps instead of gliding. */
  get jumps(): boolean {
    return this.reducedMotion?.matches ?? false;
  }

  /** Whether zooming keeps what is under the pointer in its place, which three.js only does in a whole picture. */
  set zoomsToPointer(on: boolean) {
    this.orbit.controls.zoomToCursor = on;
  }

  resize(width: number, height: number): void {
    this.orbit.resize(width, height);
  }

  /** Leaves room for what lies over the picture. */
  leaveRoom(covered: Covered): void {
    this.orbit.leaveRoom(covered);
    this.onChange();
  }

  /** Sets the headings from which both dancers are seen; null for a dancer alone. */
  setPlan(plan: HeadingPlan | null): void {
    this.follower.setPlan(plan);
  }

  /** Moves to a view's first shot. */
  setView(view: View, couple: Couple, seconds: number): void {
    this.view = view;
    const heading = view === 'top' ? couple.sideHeading : this.follower.sideHeading(seconds);
    this.moveTo(shotOf(view, couple, this.orbit.aspect, heading));
  }

  /** Brings both dancers into the picture, from the side nearest to where they are seen from now. */
  frame(couple: Couple, seconds: number): void {
    this.moveTo(shotOf(this.view, couple, this.orbit.aspect, this.follower.sideHeading(seconds)));
  }

  /**
   * Shows a detail of the moment `seconds` until the camera is moved in another way.
   *
   * @param made 22 x 3 joints of the dancer that was made, at that moment, metres
   */
  focusOn(detail: Detail, made: Float32Array, seconds: number, couple: Couple): void {
    const before = this.framing(couple);
    this.moveTo(focusShot(detail, made, couple, this.orbit.aspect, this.follower.sideHeading(seconds)));
    this.follower.followAs({ ...before, tracked: [0, 0], ownDistance: true, ownHeading: true }, couple);
    this.beforeFocus = before;
  }

  /** Frames the couple as before the detail that the camera shows, if it still does. */
  endFocus(couple: Couple): void {
    const before = this.beforeFocus;
    if (before === null) return;
    this.moveTo(reframed(before, couple, this.orbit.aspect));
    this.follower.followAs(before, couple);
  }

  /** Turns about the target (radians) and changes the distance by a factor, as a gesture of the person would. */
  step(turn: number, factor: number): void {
    this.beginGesture();
    const { shot } = this.orbit;
    this.orbit.shot = { ...shot, heading: shot.heading + turn, distance: shot.distance * factor };
    this.endGesture();
    this.onChange();
  }

  /** Moves back or closer for a picture of another shape, unless the person chose the distance. */
  refit(couple: Couple): void {
    if (this.follower.ownDistance) return this.onChange();
    const { shot } = this.orbit;
    const { distance } = shotOf(this.view, couple, this.orbit.aspect, shot.heading);
    const framing = this.framing(couple);
    this.moveTo({ ...shot, distance });
    // The couple has not moved, and a panned view stays relative to it.
    this.follower.followAs(framing, couple);
  }

  /** Frames dancers who are new on the stage: the first at once, a partner with a move, unless the person moved it. */
  frameNewcomers(couple: Couple, seconds: number, atOnce: boolean): void {
    if (this.userMoved) return;
    const heading = this.follower.sideHeading(seconds, couple.sideHeading);
    const shot = shotOf(this.view, couple, this.orbit.aspect, heading);
    this.moveTo(shot);
    if (atOnce) this.placeAt(shot);
  }

  /** How the couple is framed now, or at the end of a move. */
  framing(couple: Couple): Framing {
    const shot = this.move?.to ?? this.orbit.shot;
    const [x, y, z] = shot.target;
    return {
      view: this.view,
      shot: { ...shot, target: [x - couple.x, y, z - couple.z] },
      ...this.follower.framing(couple),
      aspect: this.orbit.aspect,
    };
  }

  /** Frames the couple as another rig did, or this one in an earlier visit. */
  frameAs(framing: Framing, couple: Couple, seconds: number): void {
    this.view = framing.view;
    this.userMoved = framing.ownDistance || framing.ownHeading;
    this.follower.followAs(framing, couple);
    const shot = reframed(framing, couple, this.orbit.aspect);
    this.placeAt(shot);
    if (this.follower.turnsIn(this.view))
      this.placeAt({ ...shot, heading: this.follower.sideHeading(seconds) });
    this.onChange();
  }

  /** Goes on by `dt` seconds; true while the camera is still moving. */
  update(dt: number, dance: Dance): boolean {
    const { move, follower, jumps } = this;
    const moving = move
      ? this.glide(move, dt)
      : follower.follow(this.view, dt, dance, { held: this.gestureStart !== null, jumps });
    return this.orbit.controls.update(dt) || moving;
  }

  dispose(): void {
    this.orbit.controls.dispose();
  }

  private placeAt(shot: Shot): void {
    this.move = null;
    this.orbit.shot = shot;
  }

  private moveTo(shot: Shot): void {
    this.beforeFocus = null;
    this.follower.startFrom(shot);
    const from = this.orbit.shot;
    const to = { ...shot, heading: nearestAngle(shot.heading, from.heading) };
    if (this.jumps) this.placeAt(to);
    else this.move = new ShotMove(from, to);
    this.onChange();
  }

  /** A camera that jumps has no damping either; a move that is going on ends at once. */
  private readonly applyPreference = (): void => {
    this.orbit.controls.enableDamping = !this.jumps;
    if (!this.jumps || this.move === null) return;
    this.placeAt(this.move.to);
    this.onChange();
  };

  private beginGesture(): void {
    this.move = null;
    this.userMoved = true;
    this.beforeFocus = null;
    // When one of two fingers is lifted, the other starts anew: it is all one gesture.
    this.gestureStart ??= this.orbit.shot;
  }

  private endGesture(): void {
    if (this.gestureStart === null) return;
    const { zoomed, dragged } = gestureBetween(this.gestureStart, this.orbit.shot);
    if (zoomed) this.follower.ownDistance = true;
    if (dragged) this.follower.ownHeading = true;
    this.gestureStart = null;
  }

  /** Goes on with a move; always true, so that the frame after the last step is drawn too. */
  private glide(move: ShotMove, dt: number): true {
    this.orbit.shot = move.advance(dt);
    if (move.ended) this.move = null;
    return true;
  }
}
