import { PerspectiveCamera, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { cutAlong, glideAlong, type Seen } from './following';
import {
  FIELD_OF_VIEW,
  fitDistance,
  measureCouple,
  nearestTurn,
  reframed,
  shotOf,
  type Couple,
  type Framing,
  type Shot,
  type View,
} from './framing';

/** The camera: the person's hand on it, the views, and how it keeps the couple in the picture. */
export interface CameraRig {
  readonly camera: PerspectiveCamera;
  /** Where the eye stands around the target, radians about y. */
  readonly heading: number;
  /** Whether it jumps instead of gliding. */
  readonly jumps: boolean;
  resize(width: number, height: number): void;
  /** Moves the middle of the picture to the right by `pixels`. */
  shift(pixels: number): void;
  /** Goes to a view's first shot. */
  setView(view: View, couple: Couple): void;
  /** Returns to the couple, both in the picture, from the side it is seen now. */
  frame(couple: Couple): void;
  /** Steps back or closer for a picture of another shape, unless the person chose the distance. */
  refit(couple: Couple): void;
  /** Shows dancers who have just come on: the first at once, a partner with a move, unless the person moved it. */
  introduce(couple: Couple, atOnce: boolean): void;
  /** How the couple is seen now, or at the end of a move. */
  framing(couple: Couple): Framing;
  /** Sees the couple as another rig did. */
  frameAs(framing: Framing, couple: Couple): void;
  /**
   * Moves on by `dt` seconds; true while it is still moving.
   *
   * @param danced whether the couple moved since the last frame.
   */
  update(dt: number, couple: Couple, danced: boolean): boolean;
  dispose(): void;
}

const MOVE_SECONDS = 0.6;

const inOut = (t: number): number => (t < 0.5 ? 4 * t ** 3 : 1 - (2 - 2 * t) ** 3 / 2);

/**
 * @param surface element that takes the pointer.
 * @param onChange called when the person moves the camera.
 * @param calm the person's wish for less movement, with which the camera jumps; null for pictures that leave the page
 */
export function createCameraRig(
  surface: HTMLElement,
  onChange: () => void,
  calm: MediaQueryList | null,
): CameraRig {
  const camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 80);
  const controls = new OrbitControls(camera, surface);
  controls.enableDamping = true;
  controls.dampingFactor = 0.12;
  controls.minDistance = 1.2;
  // From farther away the pool of light is too small to stand on.
  controls.maxDistance = 10;
  controls.maxPolarAngle = Math.PI / 2 + 0.06;
  controls.zoomSpeed = 0.8;
  controls.addEventListener('change', onChange);

  let view: View = 'orbit';
  let move: { from: Shot; to: Shot; done: number } | null = null;
  let touched = false;
  /** The person has chosen a distance, which is then left alone. */
  let ownDistance = false;
  /** Where the couple was when the camera last went along; what the person panned stays beside it. */
  const tracked = new Vector3();
  const spherical = new Spherical();
  const offset = new Vector3();
  const jumps = (): boolean => calm?.matches ?? false;

  let size = { width: 1, height: 1 };
  let aside = 0;
  const project = (): void => {
    camera.setViewOffset(size.width, size.height, -aside, 0, size.width, size.height);
  };

  const current = (): Shot => {
    spherical.setFromVector3(offset.copy(camera.position).sub(controls.target));
    return {
      target: [controls.target.x, controls.target.y, controls.target.z],
      distance: spherical.radius,
      heading: spherical.theta,
      elevation: Math.PI / 2 - spherical.phi,
    };
  };
  const stand = (shot: Shot): void => {
    controls.target.set(...shot.target);
    spherical.set(shot.distance, Math.PI / 2 - shot.elevation, shot.heading);
    camera.position.setFromSpherical(spherical).add(controls.target);
    camera.lookAt(controls.target);
  };
  const go = (shot: Shot): void => {
    ownDistance = false;
    tracked.set(...shot.target);
    const from = current();
    const to = { ...shot, heading: nearestTurn(shot.heading, from.heading) };
    if (jumps()) {
      move = null;
      stand(to);
    } else move = { from, to, done: 0 };
    onChange();
  };

  stand(shotOf(view, measureCouple([]), camera.aspect, 0));
  /** A camera that does not glide stops with the hand; what is on its way is there at once. */
  const settle = (): void => {
    controls.enableDamping = !jumps();
    if (!jumps() || move === null) return;
    stand(move.to);
    move = null;
    onChange();
  };
  settle();
  calm?.addEventListener('change', settle);

  // Dollying and panning are told apart from turning by what they change.
  let held: Shot | null = null;
  controls.addEventListener('start', () => {
    move = null;
    touched = true;
    // When one of two fingers is lifted, the other starts anew: it is all one gesture.
    held ??= current();
  });
  controls.addEventListener('end', () => {
    const now = current();
    if (held === null) return;
    if (Math.abs(now.distance - held.distance) > 0.01) ownDistance = true;
    held = null;
  });

  return {
    camera,
    get heading() {
      return current().heading;
    },
    get jumps() {
      return jumps();
    },
    resize(width, height) {
      camera.aspect = width / height;
      size = { width, height };
      project();
    },
    shift(pixels) {
      aside = pixels;
      project();
      onChange();
    },
    setView(next, couple) {
      view = next;
      go(shotOf(next, couple, camera.aspect, view === 'top' ? couple.square : current().heading));
    },
    frame(couple) {
      go({ ...shotOf(view, couple, camera.aspect, current().heading) });
    },
    refit(couple) {
      const shot = current();
      if (ownDistance) return onChange();
      const { distance } = shotOf(view, couple, camera.aspect, shot.heading);
      const beside = tracked.clone();
      go({ ...shot, distance });
      // The couple has not moved, and what was panned stays beside it.
      tracked.copy(beside);
    },
    introduce(couple, atOnce) {
      if (touched) return;
      const shot = shotOf(view, couple, camera.aspect, couple.square);
      go(shot);
      if (!atOnce) return;
      move = null;
      stand(shot);
    },
    framing(couple) {
      const shot = move?.to ?? current();
      const [x, y, z] = shot.target;
      return {
        view,
        shot: { ...shot, target: [x - couple.x, y, z - couple.z] },
        tracked: [tracked.x - couple.x, tracked.z - couple.z],
        ownDistance,
        aspect: camera.aspect,
      };
    },
    frameAs(framing, couple) {
      ({ view, ownDistance } = framing);
      touched = true;
      move = null;
      stand(reframed(framing, couple, camera.aspect));
      tracked.set(couple.x + framing.tracked[0], 0, couple.z + framing.tracked[1]);
      onChange();
    },
    update(dt, couple, danced) {
      let moving = true;
      if (move !== null) {
        move.done = Math.min(1, move.done + dt / MOVE_SECONDS);
        const t = inOut(move.done);
        const { from, to } = move;
        const between = (a: number, b: number): number => a + (b - a) * t;
        stand({
          target: [
            between(from.target[0], to.target[0]),
            between(from.target[1], to.target[1]),
            between(from.target[2], to.target[2]),
          ],
          distance: between(from.distance, to.distance),
          heading: between(from.heading, to.heading),
          elevation: between(from.elevation, to.elevation),
        });
        if (move.done === 1) move = null;
      } else moving = track(dt, couple, danced);
      return controls.update(dt) || moving;
    },
    dispose() {
      calm?.removeEventListener('change', settle);
      controls.dispose();
    },
  };

  /** Goes along with the couple; true while it moves. */
  function track(dt: number, couple: Couple, danced: boolean): boolean {
    const shot = current();
    const seen: Seen = {
      view,
      aspect: camera.aspect,
      away: [couple.x - tracked.x, couple.z - tracked.z],
      distance: shot.distance,
      goal: fitDistance(couple, camera.aspect),
      free: !ownDistance && held === null && view !== 'top',
    };
    const { by, distance, moving } = jumps() ? cutAlong(seen) : glideAlong(seen, dt, danced);
    offset.set(by[0], 0, by[1]);
    tracked.add(offset);
    controls.target.add(offset);
    camera.position.add(offset);
    if (distance !== null) stand({ ...current(), distance });
    return moving;
  }
}
