import { Group } from 'three';
import type { Look } from '../theme';
import { createBones } from './bones';
import { createContactRings } from './contact-rings';
import { createFacing } from './facing';
import { createHandLinks } from './hand-links';
import type { Figure, Overlay } from './overlay';
import { createTrails } from './trails';

/** Which overlays are on. `skeleton` makes the bodies see-through, `ghost` shows the coarse layer as a dancer of its own. */
export interface VisibleOverlays {
  readonly skeleton: boolean;
  readonly trails: boolean;
  readonly contacts: boolean;
  readonly facing: boolean;
  readonly hands: boolean;
  readonly ghost: boolean;
}

export const NO_OVERLAYS: VisibleOverlays = {
  skeleton: false,
  trails: false,
  contacts: false,
  facing: false,
  hands: false,
  ghost: false,
};

type DrawnOverlay = Exclude<keyof VisibleOverlays, 'ghost'>;

/** All overlays but the ghost, which is a dancer. An overlay that is off costs nothing. */
export interface Overlays {
  readonly object: Group;
  setVisible(visible: VisibleOverlays): void;
  update(figures: readonly Figure[], seconds: number): void;
  setLook(look: Look): void;
  dispose(): void;
}

export function createOverlays(): Overlays {
  const overlays: Readonly<Record<DrawnOverlay, Overlay>> = {
    skeleton: createBones(),
    trails: createTrails(),
    contacts: createContactRings(),
    facing: createFacing(),
    hands: createHandLinks(),
  };
  const all = Object.entries(overlays) as [DrawnOverlay, Overlay][];
  const object = new Group();
  let visible = NO_OVERLAYS;
  return {
    object,
    setVisible(next) {
      visible = next;
      object.clear();
      for (const [name, overlay] of all) if (visible[name]) object.add(overlay.object);
    },
    update(figures, seconds) {
      for (const [name, overlay] of all) if (visible[name]) overlay.update(figures, seconds);
    },
    setLook(look) {
      for (const [, overlay] of all) overlay.setLook(look);
    },
    dispose() {
      for (const [, overlay] of all) overlay.dispose();
    },
  };
}
