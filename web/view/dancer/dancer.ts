import { BufferGeometry, Group, SkinnedMesh } from 'three';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import { JOINT_COUNT } from '../../motion/skeleton/skeleton';
import { toGeometry, type BodyGeometry } from '../body/geometry';
import type { BodyLibrary } from '../body/library';
import type { Body } from '../body/simplify';
import { BUILDS } from '../body/part';
import { gesture } from './gesture';
import { createGlass, type Clarity } from './ghost-material';
import type { Paint } from './body-material';
import { blendPose, createPose, samplePose } from './pose';
import { createRig, type Rig } from './rig';
import type { Look, Role } from '../theme';

/** What a body is made of: solid; glass around bones; the coarse layer's ghost; the ghost of another take. */
export type Matter = 'solid' | 'glass' | 'coarse' | 'other';

/** One mannequin on the stage. */
export interface Dancer {
  readonly object: Group;
  readonly rig: Rig;
  readonly motion: SolvedMotion | null;
  /** Gives it another dance, or none; with `softly`, it passes over to it. The body is made in the background. */
  setMotion(motion: SolvedMotion | null, softly?: boolean): void;
  /** Goes on passing over, by seconds; true while the pose changes by it. */
  advance(dt: number): boolean;
  setMatter(matter: Matter): void;
  /** Takes the colours of a role; its own until then. */
  colourAs(role: Role): void;
  /** Says whether the body is so small in the picture that its light triangles show no less. */
  setFar(far: boolean): void;
  /** Hides a dancer who has a motion, or lets them be seen again. */
  show(on: boolean): void;
  /** Resolves when the body for the latest motion is on. */
  dressed(): Promise<void>;
  /** Takes the pose of its motion at a moment. */
  pose(seconds: number): void;
  /** Turns head and hands towards a partner who has been posed as well. */
  attend(partner: Dancer): void;
  /** 22 x 3 world positions in metres as drawn; all zero without a motion. */
  jointPositions(): Float32Array;
  setLook(look: Look): void;
  dispose(): void;
}

const CLARITY: Readonly<Record<Exclude<Matter, 'solid'>, Clarity>> = {
  glass: { facing: 0.14, grazing: 0.75 },
  coarse: { facing: 0.13, grazing: 0.85 },
  other: { facing: 0.24, grazing: 0.95 },
};

/** Seconds that passing from one dance to another takes. */
const PASSAGE = 0.25;

/**
 * @param paint of the solid body; the dancer's own, who disposes of it
 * @param onBody called when the body has been meshed and the picture changes.
 */
export function createDancer(role: Role, library: BodyLibrary, paint: Paint, onBody: () => void): Dancer {
  const rig = createRig();
  const mesh = new SkinnedMesh(new BufferGeometry(), paint.material);
  mesh.name = role;
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  // The bones carry the body across the floor, beyond the bounds of the bind pose.
  mesh.frustumCulled = false;
  mesh.bind(rig.skeleton);
  mesh.onBeforeShadow = () => geometry?.lighten(true);
  mesh.onAfterShadow = () => geometry?.lighten(far);
  const glass = createGlass(rig.skeleton);
  const object = new Group();
  object.add(rig.root);
  object.visible = false;

  const pose = createPose();
  const coming = createPose();
  const joints = new Float32Array(JOINT_COUNT * 3);
  let motion: SolvedMotion | null = null;
  /** The dance that it passes over from, and how far it has, 0 to 1. */
  let former: SolvedMotion | null = null;
  let passed = 0;
  let matter: Matter = 'solid';
  let colours = role;
  let shown = true;
  let far = false;
  let look: Look | null = null;
  let dressing = Promise.resolve();
  let worn: Body | null = null;
  let geometry: BodyGeometry | null = null;

  function wear(body: Body): void {
    worn = body;
    geometry?.dispose();
    geometry = toGeometry(body);
    geometry.lighten(far);
    mesh.geometry = geometry.near;
    glass.setGeometry(geometry.light);
    rig.bind(body.offsets);
    dress();
    onBody();
  }
  /** Puts on the body that the matter asks for, once there is one. */
  function dress(): void {
    object.visible = motion !== null && shown;
    const solid = matter === 'solid';
    if (look !== null) {
      paint.setTint(look[colours]);
      // Ghosts have tints of their own in the reactor's family.
      const ghost = matter === 'coarse' || matter === 'other' ? matter : null;
      const tint = look[ghost !== null && colours === 'reactor' ? ghost : colours];
      if (!solid) glass.setTint(tint, CLARITY[matter as Exclude<Matter, 'solid'>]);
    }
    glass.setShadow(matter === 'glass');
    if (geometry === null) return;
    object.remove(mesh, glass.object);
    object.add(solid ? mesh : glass.object);
  }

  return {
    object,
    rig,
    get motion() {
      return motion;
    },
    setMotion(next, softly = false) {
      if (next === motion) return;
      former = softly && next ? motion : null;
      passed = 0;
      motion = next;
      dress();
      if (next === null) return;
      rig.fit(next.offsets);
      dressing = library.request(next.offsets, BUILDS[role]).then((body) => {
        // Only the latest dance dresses the dancer; an earlier body may arrive later.
        if (motion === next && body !== worn) wear(body);
      });
    },
    advance(dt) {
      if (!former) return false;
      passed += dt / PASSAGE;
      if (passed >= 1) former = null;
      return true;
    },
    setMatter(next) {
      if (next === matter) return;
      matter = next;
      dress();
    },
    colourAs(next) {
      if (next === colours) return;
      colours = next;
      dress();
    },
    setFar(on) {
      if (on === far) return;
      far = on;
      geometry?.lighten(far);
    },
    show(on) {
      shown = on;
      object.visible = motion !== null && shown;
    },
    dressed: () => dressing,
    pose(seconds) {
      if (motion === null) return;
      samplePose(former ?? motion, seconds, pose);
      if (former) {
        samplePose(motion, seconds, coming);
        blendPose(pose, coming, passed * passed * (3 - 2 * passed));
      }
      rig.apply(pose);
    },
    attend(partner) {
      gesture(rig, partner.rig);
    },
    jointPositions() {
      return motion === null ? joints.fill(0).slice() : rig.jointPositions(joints).slice();
    },
    setLook(next) {
      look = next;
      dress();
    },
    dispose() {
      motion = null;
      geometry?.dispose();
      paint.material.dispose();
      glass.dispose();
      rig.skeleton.dispose();
    },
  };
}
