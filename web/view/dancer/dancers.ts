import { otherRole, ROLES, type Role } from '../../common/role';
import { Group } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { BodyLibrary } from '../body/library';
import { measureCouple, type Couple } from '../camera/framing';
import type { Viewport } from '../canvas';
import type { Figure } from '../overlays/overlay';
import { NO_OVERLAYS, type VisibleOverlays } from '../../common/picture';
import { type Look } from '../theme';
import type { BodyMaterial } from './body-material';
import { Dancer } from './dancer';

/**
 * Leader and reactor, the coarse layer of the first take, the other take, its coarse layer, and the dance before a
 * change.
 */
export type DancerName = Role | 'coarse' | 'other' | 'otherCoarse' | 'earlier';
const NAMES = [
  'leader',
  'reactor',
  'coarse',
  'other',
  'otherCoarse',
  'earlier',
] as const satisfies readonly DancerName[];

/** How the other take is seen: as a ghost, or in this half of a split view, with the first take in the other half. */
export type OtherMode = 'ghost' | 'left' | 'right';

/** All dancers that can be on the stage, and which of them each viewport shows. */
export class Dancers {
  readonly object = new Group();
  private readonly dancers: Readonly<Record<DancerName, Dancer>>;
  private overlays = NO_OVERLAYS;
  private mode: OtherMode = 'ghost';
  private made: Role = 'reactor';
  private posedAt = 0;
  /** Whom the loaded dancer has turned to since the last pose. */
  private turnedTo: DancerName | null = null;

  /**
   * @param createMaterial makes the material of a solid body
   * @param onBody called when a dancer has got a body
   */
  constructor(library: BodyLibrary, createMaterial: () => BodyMaterial, onBody: () => void) {
    const dancer = (role: Role): Dancer => new Dancer(role, library, createMaterial(), onBody);
    this.dancers = {
      leader: dancer('leader'),
      reactor: dancer('reactor'),
      coarse: dancer('reactor'),
      other: dancer('reactor'),
      otherCoarse: dancer('reactor'),
      earlier: dancer('reactor'),
    };
    this.dancers.coarse.body.setStyle('coarse');
    this.dancers.otherCoarse.body.setStyle('coarse');
    this.dancers.earlier.body.setStyle('other');
    for (const { object } of this.all) this.object.add(object);
    this.updateStyles();
  }

  /** Whether the other take has a half of the picture of its own. */
  get split(): boolean {
    return this.mode !== 'ghost' && this.isPresent('other');
  }

  /** How many of leader and reactor are on the stage. */
  get present(): number {
    return ROLES.filter((role) => this.isPresent(role)).length;
  }

  /** Gives a dancer another motion, or none, at once or with a crossfade. */
  setMotion(name: DancerName, motion: SolvedMotion | null, crossfade = false): void {
    this.dancers[name].setMotion(motion, crossfade);
  }

  /** Takes a ghost off the stage, fading it out. */
  fadeOut(name: DancerName): void {
    this.dancers[name].fadeOut();
  }

  /** Sets the role that the model made: that of all ghosts and the other take. All share the dancer of the other role. */
  setMade(role: Role): void {
    this.made = role;
    for (const name of ['coarse', 'other', 'otherCoarse', 'earlier'] as const)
      this.dancers[name].body.setColours(role);
  }

  setOtherMode(mode: OtherMode): void {
    this.mode = mode;
    this.updateStyles();
  }

  setOverlays(overlays: VisibleOverlays): void {
    this.overlays = overlays;
    this.updateStyles();
  }

  setLook(look: Look): void {
    for (const { body } of this.all) body.setLook(look);
  }

  /** Draws all bodies with fewer triangles, for when they are small in the picture. */
  setLowDetail(on: boolean): void {
    for (const { body } of this.all) body.setLowDetail(on);
  }

  /** Resolves when every dancer has a body. */
  async bodiesReady(): Promise<void> {
    await Promise.all(this.all.map((dancer) => dancer.bodyReady()));
  }

  /** Goes on with fades by `dt` seconds; true while the picture changes by them. */
  advance(dt: number): boolean {
    return this.all.filter((dancer) => dancer.advance(dt)).length > 0;
  }

  /** Poses all dancers at a moment and measures where the couple is. */
  pose(seconds: number): Couple {
    this.posedAt = seconds;
    this.turnedTo = null;
    const present = NAMES.filter((name) => this.isPresent(name));
    for (const name of present) this.dancers[name].pose(seconds);
    if (this.isPresent(this.loaded))
      for (const name of present)
        if (name !== this.loaded) this.dancers[name].turnTowards(this.dancers[this.loaded]);
    const couple = ROLES.filter((role) => this.isPresent(role)).map((role) => this.joints(role));
    return measureCouple(couple, this.isPresent('other') ? [this.joints('other')] : []);
  }

  /**
   * Shows the dancers of one viewport: the loaded dancer, turned to the take that the viewport shows, that take, and
   * its coarse layer where the `ghost` overlay is on.
   *
   * @returns the couple in it, for contact shadows and overlays
   */
  arrange(viewport: Viewport): readonly Figure[] {
    const { dancers, loaded, made, overlays } = this;
    const showsOther = viewport === this.mode;
    const partner = showsOther ? 'other' : made;
    this.turnLoadedTo(partner);
    dancers[loaded].show(true);
    dancers[made].show(!showsOther);
    dancers.coarse.show(!showsOther && overlays.ghost);
    dancers.other.show(showsOther || (viewport === 'whole' && this.mode === 'ghost'));
    dancers.otherCoarse.show(showsOther && overlays.ghost);
    dancers.earlier.show(viewport === 'whole');
    return [...this.figure(loaded, loaded), ...this.figure(made, partner)];
  }

  /** Joints of all dancers in the viewport that was arranged last, 22 x 3 world positions each, metres. */
  visibleJoints(): readonly Float32Array[] {
    return this.all.filter(({ object }) => object.visible).map((dancer) => dancer.jointPositions());
  }

  /** Motions of leader and reactor; null while one of them is not on the stage. */
  get couple(): readonly [leader: SolvedMotion, reactor: SolvedMotion] | null {
    const [leader, reactor] = ROLES.map((role) => this.dancers[role].motion);
    return leader && reactor ? [leader, reactor] : null;
  }

  /** 22 x 3 joints of the dancer that was made at a moment, metres; null without one. */
  madeAt(seconds: number): Float32Array | null {
    const { motion } = this.dancers[this.made];
    if (motion === null) return null;
    const frame = Math.min(motion.frames - 1, Math.max(0, Math.round(seconds * motion.fps)));
    const width = JOINT_COUNT * 3;
    return motion.positions.slice(frame * width, (frame + 1) * width);
  }

  /** 22 x 3 world positions in metres; all zero without a motion. */
  joints(name: DancerName): Float32Array {
    return this.dancers[name].jointPositions();
  }

  dispose(): void {
    for (const dancer of this.all) dancer.dispose();
  }

  private get all(): Dancer[] {
    return NAMES.map((name) => this.dancers[name]);
  }

  /** The role whose motion was loaded, not made. */
  private get loaded(): Role {
    return otherRole(this.made);
  }

  private isPresent(name: DancerName): boolean {
    return this.dancers[name].motion !== null;
  }

  private updateStyles(): void {
    const style = this.overlays.skeleton ? 'translucent' : 'solid';
    this.dancers.leader.body.setStyle(style);
    this.dancers.reactor.body.setStyle(style);
    this.dancers.other.body.setStyle(this.mode === 'ghost' ? 'other' : style);
  }

  /** Turns the loaded dancer to a partner, from the pose of the motion if it has turned to another one before. */
  private turnLoadedTo(partner: DancerName): void {
    if (this.turnedTo === partner || !this.isPresent(this.loaded)) return;
    const loaded = this.dancers[this.loaded];
    if (this.turnedTo !== null) loaded.pose(this.posedAt);
    this.turnedTo = partner;
    if (this.isPresent(partner)) loaded.turnTowards(this.dancers[partner]);
  }

  private figure(role: Role, name: DancerName): Figure[] {
    const { motion } = this.dancers[name];
    return motion === null ? [] : [{ role, motion, joints: this.joints(name) }];
  }
}
