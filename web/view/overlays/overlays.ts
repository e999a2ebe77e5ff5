import { Group } from 'three';
import type { Look } from '../theme';
import { createBones } from './bones';
import { createContactRings } from './contact-rings';
import { createFacing } from './facing';
import { createHandLinks } from './hand-links';
import type { Figure, Show } from './overlay';
import { createTrails } from './trails';

/** What may be shown about the dancers. `skeleton` turns their bodies to glass, `ghost` is the coarse layer. */
export interface Shown {
  readonly skeleton: boolean;
  readonly trails: boolean;
  readonly contacts: boolean;
  readonly facing: boolean;
  readonly hands: boolean;
  readonly ghost: boolean;
}

export const NOTHING_SHOWN: Shown = {
  skeleton: false,
  trails: false,
  contacts: false,
  facing: false,
  hands: false,
  ghost: false,
};

type Drawn = Exclude<keyof Shown, 'ghost'>;

/** All shows but the ghosts, which are dancers. A show that nobody asked for costs nothing. */
export interface Shows {
  readonly object: Group;
  setShown(shown: Shown): void;
  update(figures: readonly Figure[], seconds: number): void;
  setLook(look: Look): void;
  dispose(): void;
}

export function createShows(): Shows {
  const shows: Readonly<Record<Drawn, Show>> = {
    skeleton: createBones(),
    trails: createTrails(),
    contacts: createContactRings(),
    facing: createFacing(),
    hands: createHandLinks(),
  };
  const all = Object.entries(shows) as [Drawn, Show][];
  const object = new Group();
  let shown = NOTHING_SHOWN;
  return {
    object,
    setShown(next) {
      shown = next;
      object.clear();
      for (const [name, show] of all) if (shown[name]) object.add(show.object);
    },
    update(figures, seconds) {
      for (const [name, show] of all) if (shown[name]) show.update(figures, seconds);
    },
    setLook(look) {
      for (const [, show] of all) show.setLook(look);
    },
    dispose() {
      for (const [, show] of all) show.dispose();
    },
  };
}
