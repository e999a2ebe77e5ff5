import { Quaternion, Vector3 } from 'three';
import { J } from '../../motion/skeleton/skeleton';
import { ramp } from '../body/field';
import type { Rig } from './rig';

/**
 * What a captured pose does not say and a viewer misses: eyes and hands. A head looks a little at the partner, a hand
 * turns towards the hand it holds. Only the last bones of the chains are turned, so every joint stays where the motion
 * has it.
 */

const GAZE = 0.55;
const MOST_YAW = 1.1;
const MOST_PITCH = 0.45;
/** Wrists further apart than this do not hold hands, metres. */
const HOLDING = 0.45;
const MOST_BEND = 0.7;

const HANDS = [
  { wrist: J.left_wrist, outward: new Vector3(1, 0, 0) },
  { wrist: J.right_wrist, outward: new Vector3(-1, 0, 0) },
] as const;
const UP = new Vector3(0, 1, 0);
const SIDE = new Vector3(1, 0, 0);

const point = new Vector3();
const other = new Vector3();
const direction = new Vector3();
const frame = new Quaternion();
const turn = new Quaternion();

/** World rotation of a bone, undone; bones are never scaled. */
const intoParent = (rig: Rig, joint: number): Quaternion => {
  const parent = rig.bones[joint]!.parent!;
  return parent.getWorldQuaternion(frame).invert();
};

/** Turns head and hands of `rig` towards `partner`; both have been posed before. */
export function gesture(rig: Rig, partner: Rig): void {
  look(rig, partner);
  for (const hand of HANDS) reach(rig, partner, hand.wrist, hand.outward);
}

function look(rig: Rig, partner: Rig): void {
  const head = rig.bones[J.head]!;
  point.setFromMatrixPosition(head.matrixWorld);
  direction.setFromMatrixPosition(partner.bones[J.head]!.matrixWorld).sub(point);
  if (direction.lengthSq() < 0.01) return;
  direction.applyQuaternion(intoParent(rig, J.head)).normalize();
  const yaw = Math.atan2(direction.x, direction.z);
  const pitch = -Math.asin(direction.y);
  // Nobody looks over their back: the wish fades as the partner passes behind.
  const wish = GAZE * (1 - ramp(1.5, 2.6, Math.abs(yaw)));
  const within = (angle: number, most: number): number => most * Math.tanh((angle * wish) / most);
  head.quaternion.multiply(turn.setFromAxisAngle(UP, within(yaw, MOST_YAW)));
  head.quaternion.multiply(turn.setFromAxisAngle(SIDE, within(pitch, MOST_PITCH)));
  head.updateMatrixWorld(true);
}

function reach(rig: Rig, partner: Rig, joint: number, outward: Vector3): void {
  const wrist = rig.bones[joint]!;
  point.setFromMatrixPosition(wrist.matrixWorld);
  direction.set(0, 0, 0);
  let strength = 0;
  for (const { wrist: theirs } of HANDS) {
    other.setFromMatrixPosition(partner.bones[theirs]!.matrixWorld).sub(point);
    const gap = other.length();
    // Both hands are weighed, so that passing from one to the other is smooth; a direction needs some length.
    const weight = (1 - ramp(0.15, HOLDING, gap)) * ramp(0.02, 0.1, gap);
    direction.addScaledVector(other, weight / Math.max(gap, 1e-3));
    strength = Math.max(strength, weight);
  }
  if (strength < 1e-3 || direction.lengthSq() < 1e-6) return;
  direction.applyQuaternion(intoParent(rig, joint)).normalize();
  const bend = outward.angleTo(direction);
  if (bend < 1e-3) return;
  other.crossVectors(outward, direction);
  if (other.lengthSq() < 1e-8) return;
  const angle = MOST_BEND * Math.tanh((bend * strength * (1 - ramp(1.6, 2.8, bend))) / MOST_BEND);
  wrist.quaternion.premultiply(turn.setFromAxisAngle(other.normalize(), angle));
  wrist.updateMatrixWorld(true);
}
