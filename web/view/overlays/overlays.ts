import { Group } from 'three';
import { NO_OVERLAYS, type VisibleOverlays } from '../../common/picture';
import type { Look } from '../theme';
import { createBones } from './bones';
import { createContactRings } from './contact-rings';
import { createFacing } from './facing';
import { createHandLinks } from './hand-links';
import type { Figure, Overlay } from './overlay';
import { createTrails } from './trails';

type DrawnOverlay = Exclude<keyof VisibleOverlays, 'ghost'>;

/** All overlays but the ghost, which is a dancer. An overlay that is off costs nothing. */
interface Overlays {
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
