import type { Role } from '../../common/role';
import { Group } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import type { BodyLibrary } from '../body/library';
import { BUILDS } from '../body/part';
import type { Body } from '../body/simplify';
import type { BodyMaterial } from './body-material';
import { DancerBody } from './dancer-body';
import { gesture, levelHead } from './gesture';
import { blendPose, createPose, samplePose } from './pose';
import { createRig } from './rig';

/** Duration of the crossfade from one motion to the next, seconds. */
const CROSSFADE = 0.25;
/** Duration in which a ghost that leaves the stage fades out, seconds. */
const FADE_OUT = 0.4;

/** One mannequin on the stage: bones that follow a motion, and a body on them. */
export class Dancer {
  readonly object = new Group();
  readonly body: DancerBody;
  private readonly rig = createRig();
  private readonly currentPose = createPose();
  private readonly nextPose = createPose();
  private currentMotion: SolvedMotion | null = null;
  /** Motions that are faded out, the oldest first, and how far the motion after each has taken its place, 0 to 1. */
  private fading: { readonly motion: SolvedMotion; fade: number }[] = [];
  /** Share of its opacity that is left while it fades out, null while it stays. */
  private leaving: number | null = null;
  private visible = true;
  private bodyRequest = Promise.resolve();
  private shownBody: Body | null = null;

  /**
   * @param material of the solid body, disposed of with the dancer
   * @param onBody called when a body has been meshed and the picture changes.
   */
  constructor(
    private readonly role: Role,
    private readonly library: BodyLibrary,
    material: BodyMaterial,
    private readonly onBody: () => void,
  ) {
    this.body = new DancerBody(this.rig, material, role);
    this.object.add(this.rig.root, this.body.object);
    this.object.visible = false;
  }

  get motion(): SolvedMotion | null {
    return this.currentMotion;
  }

  /**
   * Takes another motion, or none, at once or with a crossfade, which begins at the pose that is shown, also where that
   * is a blend. A body for its skeleton is made in the background.
   */
  setMotion(motion: SolvedMotion | null, crossfade = false): void {
    this.leave(null);
    if (motion === this.currentMotion) return;
    if (!crossfade || !motion) this.fading = [];
    else if (this.currentMotion) this.fading.push({ motion: this.currentMotion, fade: 0 });
    this.currentMotion = motion;
    this.updateVisibility();
    if (motion === null) return;
    this.rig.fit(motion.offsets);
    this.bodyRequest = this.library.request(motion.offsets, BUILDS[this.role]).then((body) => {
      // Bodies may come in another order than they were asked for; only the latest motion's is taken.
      if (this.currentMotion !== motion || body === this.shownBody) return;
      this.shownBody = body;
      this.body.setBody(body);
      this.onBody();
    });
  }

  /** Resolves when the body for the latest motion is shown. */
  bodyReady(): Promise<void> {
    return this.bodyRequest;
  }

  /** Hides a dancer who has a motion, or shows them again. */
  show(on: boolean): void {
    this.visible = on;
    this.updateVisibility();
  }

  /** Takes a ghost off the stage, fading it out. */
  fadeOut(): void {
    if (this.currentMotion) this.leave(this.leaving ?? 1);
  }

  /** Goes on with fades by `dt` seconds; true while the picture changes by them. */
  advance(dt: number): boolean {
    if (this.leaving !== null) {
      this.leave(this.leaving - dt / FADE_OUT);
      if (this.leaving <= 0) this.setMotion(null);
      return true;
    }
    if (this.fading.length === 0) return false;
    for (const part of this.fading) part.fade += dt / CROSSFADE;
    this.fading = this.fading.filter(({ fade }) => fade < 1);
    return true;
  }

  /** Takes the pose of the motion at a moment, with the head held level. */
  pose(seconds: number): void {
    if (this.currentMotion === null) return;
    const { fading, currentMotion } = this;
    samplePose(fading[0]?.motion ?? currentMotion, seconds, this.currentPose);
    fading.forEach(({ fade }, i) => {
      samplePose(fading[i + 1]?.motion ?? currentMotion, seconds, this.nextPose);
      blendPose(this.currentPose, this.nextPose, fade * fade * (3 - 2 * fade));
    });
    this.rig.apply(this.currentPose);
    levelHead(this.rig);
  }

  /** Turns head and hands towards a partner who has been posed as well. */
  turnTowards(partner: Dancer): void {
    gesture(this.rig, partner.rig);
  }

  /** 22 x 3 world positions in metres as drawn; all zero without a motion. */
  jointPositions(): Float32Array {
    const positions = new Float32Array(JOINT_COUNT * 3);
    return this.currentMotion === null ? positions : this.rig.jointPositions(positions);
  }

  dispose(): void {
    this.currentMotion = null;
    this.body.dispose();
    this.rig.skeleton.dispose();
  }

  private leave(share: number | null): void {
    this.leaving = share;
    this.body.setOpacity(Math.max(0, share ?? 1));
  }

  private updateVisibility(): void {
    this.object.visible = this.currentMotion !== null && this.visible;
  }
}
