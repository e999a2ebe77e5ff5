import { Vector3, type PerspectiveCamera } from 'three';
import { followByJumps, followSmoothly, type FollowInput } from './following';
import { nearestSide, type HeadingPlan } from './heading-plan';
import { focusShot, type Detail } from './focus';
import {
  fitDistance,
  measureCouple,
  nearestAngle,
  reframed,
  shotOf,
  type Couple,
  type Framing,
  type Shot,
  type View,
} from './framing';
import { OrbitCamera } from './orbit-camera';
import { gestureBetween, shotBetween } from './shot-change';

/** Seconds that a move from one shot to another takes. */
const MOVE_SECONDS = 0.6;
/** What a camera follows at one moment of the dance. */
interface Dance {
  readonly couple: Couple;
  readonly seconds: number;
  /** Whether the couple has moved since the last frame. */
  readonly danced: boolean;
}

/** The camera of the stage: its views, moves between them, the person's gestures, and following the couple. */
export class CameraRig {
  private readonly orbit: OrbitCamera;
  private view: View = 'orbit';
  private move: { readonly from: Shot; readonly to: Shot; done: number } | null = null;
  /** Whether the person has moved the camera. */
  private userMoved = false;
  /** Whether the person has chosen a distance, which is then kept. */
  private ownDistance = false;
  /** Whether the person has turned or panned the camera, which then does not turn by itself. */
  private ownHeading = false;
  /** How the couple was framed before the camera showed a detail; null while it shows none. */
  private beforeFocus: Framing | null = null;
  private plan: HeadingPlan | null = null;
  /** Moment that the camera last turned for, seconds: a new dance at the same moment does not turn it. */
  private turnedFor = NaN;
  /** Shot when the gesture that is going on began. */
  private gestureStart: Shot | null = null;
  /** Where the couple was when the camera last followed; the view that the person panned to stays relative to it. */
  private readonly tracked = new Vector3();

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

  resize(width: number, height: number): void {
    this.orbit.resize(width, height);
  }

  /** Moves the middle of the picture to the right by `pixels`. */
  shift(pixels: number): void {
    this.orbit.shiftPicture(pixels);
    this.onChange();
  }

  /** Sets the headings from which both dancers are seen; null for a dancer alone. */
  setPlan(plan: HeadingPlan | null): void {
    this.plan = plan;
  }

  /** Moves to a view's first shot. */
  setView(view: View, couple: Couple, seconds: number): void {
    this.view = view;
    const heading = view === 'top' ? couple.sideHeading : this.sideHeading(seconds);
    this.moveTo(shotOf(view, couple, this.orbit.aspect, heading));
  }

  /** Brings both dancers into the picture, from the side nearest to where they are seen from now. */
  frame(couple: Couple, seconds: number): void {
    this.moveTo(shotOf(this.view, couple, this.orbit.aspect, this.sideHeading(seconds)));
  }

  /**
   * Shows a detail of the moment `seconds` until the camera is moved in another way.
   *
   * @param made 22 x 3 joints of the dancer that was made, at that moment, metres
   */
  focusOn(detail: Detail, made: Float32Array, seconds: number, couple: Couple): void {
    const before = this.framing(couple);
    this.moveTo(focusShot(detail, made, couple, this.orbit.aspect, this.sideHeading(seconds)));
    this.track({ ...before, tracked: [0, 0], ownDistance: true, ownHeading: true }, couple);
    this.beforeFocus = before;
  }

  /** Frames the couple as before the detail that the camera shows, if it still does. */
  endFocus(couple: Couple): void {
    const before = this.beforeFocus;
    if (before === null) return;
    this.moveTo(reframed(before, couple, this.orbit.aspect));
    this.track(before, couple);
  }

  /** Moves back or closer for a picture of another shape, unless the person chose the distance. */
  refit(couple: Couple): void {
    if (this.ownDistance) return this.onChange();
    const { shot } = this.orbit;
    const { distance } = shotOf(this.view, couple, this.orbit.aspect, shot.heading);
    const framing = this.framing(couple);
    this.moveTo({ ...shot, distance });
    // The couple has not moved, and a panned view stays relative to it.
    this.track(framing, couple);
  }

  /** Frames dancers who are new on the stage: the first at once, a partner with a move, unless the person moved it. */
  frameNewcomers(couple: Couple, seconds: number, atOnce: boolean): void {
    if (this.userMoved) return;
    const { sideHeading } = couple;
    const heading = this.plan ? nearestSide(this.plan(seconds), sideHeading) : sideHeading;
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
      tracked: [this.tracked.x - couple.x, this.tracked.z - couple.z],
      ownDistance: this.ownDistance,
      ownHeading: this.ownHeading,
      aspect: this.orbit.aspect,
    };
  }

  /** Frames the couple as another rig did. */
  frameAs(framing: Framing, couple: Couple, seconds: number): void {
    this.view = framing.view;
    this.userMoved = true;
    this.track(framing, couple);
    const shot = reframed(framing, couple, this.orbit.aspect);
    this.placeAt(shot);
    if (this.turnsByItself) this.placeAt({ ...shot, heading: this.sideHeading(seconds) });
    this.onChange();
  }

  /** Goes on by `dt` seconds; true while the camera is still moving. */
  update(dt: number, dance: Dance): boolean {
    const moving = this.move === null ? this.follow(dt, dance) : this.glide(this.move, dt);
    return this.orbit.controls.update(dt) || moving;
  }

  dispose(): void {
    this.reducedMotion?.removeEventListener('change', this.applyPreference);
    this.orbit.controls.dispose();
  }

  /** Whether the camera turns with the couple. */
  private get turnsByItself(): boolean {
    const follows = this.view === 'orbit' || this.view === 'follow';
    return follows && !this.ownHeading && this.gestureStart === null;
  }

  /** The heading nearest to the present one from which both dancers are seen; the present one for a dancer alone. */
  private sideHeading(seconds: number): number {
    return this.plan ? nearestSide(this.plan(seconds), this.heading) : this.heading;
  }

  /** Follows the couple from now on as `framing` does. */
  private track({ tracked: [x, z], ownDistance, ownHeading }: Framing, couple: Couple): void {
    this.tracked.set(couple.x + x, 0, couple.z + z);
    this.ownDistance = ownDistance;
    this.ownHeading = ownHeading;
  }

  private placeAt(shot: Shot): void {
    this.move = null;
    this.orbit.shot = shot;
  }

  private moveTo(shot: Shot): void {
    this.ownDistance = false;
    this.ownHeading = false;
    this.beforeFocus = null;
    this.tracked.set(...shot.target);
    const from = this.orbit.shot;
    const to = { ...shot, heading: nearestAngle(shot.heading, from.heading) };
    if (this.jumps) this.placeAt(to);
    else this.move = { from, to, done: 0 };
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
    if (zoomed) this.ownDistance = true;
    if (dragged) this.ownHeading = true;
    this.gestureStart = null;
  }

  /** Goes on with a move; always true, so that the frame after the last step is drawn too. */
  private glide(move: NonNullable<CameraRig['move']>, dt: number): true {
    move.done = Math.min(1, move.done + dt / MOVE_SECONDS);
    this.orbit.shot = shotBetween(move.from, move.to, move.done);
    if (move.done === 1) this.move = null;
    return true;
  }

  /** Follows the couple; true while the camera moves. */
  private follow(dt: number, { couple, seconds, danced }: Dance): boolean {
    const input: FollowInput = {
      view: this.view,
      aspect: this.orbit.aspect,
      offset: [couple.x - this.tracked.x, couple.z - this.tracked.z],
      distance: this.orbit.shot.distance,
      fitDistance: fitDistance(couple, this.orbit.aspect),
      mayZoom: !this.ownDistance && this.gestureStart === null && this.view !== 'top',
      turn: this.turnsByItself && seconds !== this.turnedFor ? this.sideHeading(seconds) - this.heading : 0,
    };
    const { shift, distance, turn, moving } = this.jumps
      ? followByJumps(input)
      : followSmoothly(input, dt, danced);
    const [x, z] = shift;
    this.tracked.set(this.tracked.x + x, this.tracked.y, this.tracked.z + z);
    this.orbit.translate(x, z);
    if (distance !== null) this.orbit.shot = { ...this.orbit.shot, distance };
    if (turn !== 0) this.orbit.turn(turn, this.tracked);
    else this.turnedFor = seconds;
    return moving;
  }
}
