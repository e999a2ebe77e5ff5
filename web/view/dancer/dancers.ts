import { Group } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { BodyLibrary } from '../body/library';
import type { Viewport } from '../canvas';
import { createDancer, type Dancer } from './dancer';
import { measureCouple, type Couple } from '../camera/framing';
import type { Paint } from './body-material';
import type { Figure } from '../overlays/overlay';
import { NOTHING_SHOWN, type Shown } from '../overlays/overlays';
import { ROLES, type Look, type Role } from '../theme';

/** Leader and reactor; the reactor of the coarse layer alone; another take of the reactor, and its coarse layer. */
export type Part = Role | 'coarse' | 'other' | 'otherCoarse';
const PARTS = ['leader', 'reactor', 'coarse', 'other', 'otherCoarse'] as const satisfies readonly Part[];

/** How another take is seen: through the reactor, or in this half of the picture, the reactor in the other half. */
export type OtherMode = 'ghost' | 'left' | 'right';

/** Everybody who can be on the stage, and who of them is to be seen in which picture. */
export interface Cast {
  readonly object: Group;
  /** With `softly`, who is there already passes over to the other dance. */
  setMotion(part: Part, motion: SolvedMotion | null, softly?: boolean): void;
  /** Goes on passing over, by seconds; true while a pose changes by it. */
  advance(dt: number): boolean;
  /** Whose part coarse layer and other take are of; the other dancer is the same with all of them. */
  setMade(role: Role): void;
  setOtherMode(mode: OtherMode): void;
  setShown(shown: Shown): void;
  /** Says whether everybody is so small in the picture that light bodies show no less. */
  setFar(far: boolean): void;
  /** Whether there is another take to be seen beside the reactor. */
  readonly split: boolean;
  /** How many of leader and reactor are on the stage. */
  readonly present: number;
  /** Poses everybody at a moment and measures where they are. */
  pose(seconds: number): Couple;
  /**
   * Lets those be seen who are in a picture, as they were posed: in one half the couple, in the other half the loaded
   * dancer with the other take, turned to it. Each half has the coarse layer of its own take.
   */
  arrange(viewport: Viewport): readonly Figure[];
  /** Joints of everybody to be seen in the picture that was arranged last, 22 x 3 world positions each. */
  seen(): readonly Float32Array[];
  joints(part: Part): Float32Array;
  setLook(look: Look): void;
  /** Resolves when everybody has a body. */
  dressed(): Promise<void>;
  dispose(): void;
}

/**
 * @param paint makes what a solid body is painted with
 * @param onBody called when somebody has got a body
 */
export function createCast(library: BodyLibrary, paint: () => Paint, onBody: () => void): Cast {
  const dancer = (role: Role): Dancer => createDancer(role, library, paint(), onBody);
  const dancers: Readonly<Record<Part, Dancer>> = {
    leader: dancer('leader'),
    reactor: dancer('reactor'),
    coarse: dancer('reactor'),
    other: dancer('reactor'),
    otherCoarse: dancer('reactor'),
  };
  dancers.coarse.setMatter('coarse');
  dancers.otherCoarse.setMatter('coarse');
  const object = new Group();
  for (const part of PARTS) object.add(dancers[part].object);

  let shown = NOTHING_SHOWN;
  let mode: OtherMode = 'ghost';
  let posedAt = 0;
  let attended: Part | null = null;
  let made: Role = 'reactor';
  const loaded = (): Role => (made === 'reactor' ? 'leader' : 'reactor');

  const there = (part: Part): boolean => dancers[part].motion !== null;
  const split = (): boolean => mode !== 'ghost' && there('other');
  function dress(): void {
    const matter = shown.skeleton ? 'glass' : 'solid';
    dancers.leader.setMatter(matter);
    dancers.reactor.setMatter(matter);
    dancers.other.setMatter(mode === 'ghost' ? 'other' : matter);
  }
  dress();
  /** The loaded dancer looks at a partner, posed anew if it looked at another one before. */
  function attend(partner: Part): void {
    if (attended === partner || !there(loaded())) return;
    if (attended !== null) dancers[loaded()].pose(posedAt);
    attended = partner;
    if (there(partner)) dancers[loaded()].attend(dancers[partner]);
  }
  const figure = (role: Role, part: Part): Figure[] => {
    const { motion } = dancers[part];
    return motion === null ? [] : [{ role, motion, joints: dancers[part].jointPositions() }];
  };

  return {
    object,
    setMotion(part, motion, softly) {
      dancers[part].setMotion(motion, softly);
    },
    advance: (dt) => PARTS.filter((part) => dancers[part].advance(dt)).length > 0,
    setMade(role) {
      made = role;
      for (const part of ['coarse', 'other', 'otherCoarse'] as const) dancers[part].colourAs(role);
    },
    setOtherMode(next) {
      mode = next;
      dress();
    },
    setShown(next) {
      shown = next;
      dress();
    },
    setFar(far) {
      for (const part of PARTS) dancers[part].setFar(far);
    },
    get split() {
      return split();
    },
    get present() {
      return ROLES.filter(there).length;
    },
    pose(seconds) {
      posedAt = seconds;
      attended = null;
      const present = PARTS.filter(there);
      for (const part of present) dancers[part].pose(seconds);
      const constant = loaded();
      if (there(constant))
        for (const part of present) if (part !== constant) dancers[part].attend(dancers[constant]);
      const joints = (part: Part): Float32Array => dancers[part].jointPositions();
      return measureCouple(ROLES.filter(there).map(joints), there('other') ? [joints('other')] : []);
    },
    arrange(viewport) {
      const others = viewport === mode;
      const partner = others ? 'other' : made;
      attend(partner);
      dancers[loaded()].show(true);
      dancers[made].show(!others);
      dancers.coarse.show(!others && shown.ghost);
      dancers.other.show(others || (viewport === 'whole' && mode === 'ghost'));
      dancers.otherCoarse.show(others && shown.ghost);
      return [...figure(loaded(), loaded()), ...figure(made, partner)];
    },
    seen: () =>
      PARTS.filter((part) => dancers[part].object.visible).map((part) => dancers[part].jointPositions()),
    joints: (part) => dancers[part].jointPositions(),
    setLook(look) {
      for (const part of PARTS) dancers[part].setLook(look);
    },
    async dressed() {
      await Promise.all(PARTS.map((part) => dancers[part].dressed()));
    },
    dispose() {
      for (const part of PARTS) dancers[part].dispose();
    },
  };
}
