import { smoothstep } from '../../motion/math/vec3';
import { Quaternion, Vector3 } from 'three';
import { levelled, limited } from '../../motion/skeleton/level-head';
import { J } from '../../motion/skeleton/skeleton';
import type { Rig } from './rig';

/**
 * Head and hands, which the 22 joints of a motion say little about: a head is held level and turns a little to the
 * partner, a hand turns towards a hand near it. Only the last bones of the chains are turned, so every joint stays where
 * the motion has it.
 */

/** Shares of the angles to the partner by which a head turns, and its greatest angles, radians. */
const YAW_SHARE = 0.55;
const PITCH_SHARE = 0.25;
const MAX_YAW = 1.1;
const MAX_PITCH = 0.3;
/** Distance of two wrists from which on hands do not turn to each other, metres. */
const HOLD_DISTANCE = 0.45;
/** Greatest angle by which a hand turns, radians. */
const MAX_BEND = 0.7;

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
const worldTurn = new Quaternion();

/** Rotation from the world into the space of a joint's parent; bones are never scaled. */
const worldToParent = (rig: Rig, joint: number): Quaternion => {
  const parent = rig.bones[joint]!.parent!;
  return parent.getWorldQuaternion(frame).invert();
};

/** Holds the head of a posed rig level. */
export function levelHead(rig: Rig): void {
  const head = rig.bones[J.head]!;
  head.getWorldQuaternion(worldTurn);
  worldTurn.fromArray(levelled([worldTurn.x, worldTurn.y, worldTurn.z, worldTurn.w]));
  head.quaternion.multiplyQuaternions(worldToParent(rig, J.head), worldTurn);
  head.updateMatrixWorld(true);
}

/** Turns head and hands of `rig` towards `partner`; both have been posed before. */
export function gesture(rig: Rig, partner: Rig): void {
  turnHead(rig, partner);
  for (const hand of HANDS) turnHand(rig, partner, hand.wrist, hand.outward);
}

function turnHead(rig: Rig, partner: Rig): void {
  const head = rig.bones[J.head]!;
  point.setFromMatrixPosition(head.matrixWorld);
  direction.setFromMatrixPosition(partner.bones[J.head]!.matrixWorld).sub(point);
  if (direction.lengthSq() < 0.01) return;
  direction.applyQuaternion(head.getWorldQuaternion(worldTurn).invert()).normalize();
  const yaw = Math.atan2(direction.x, direction.z);
  const pitch = -Math.asin(direction.y);
  // Nobody looks over their back: the share falls to zero as the partner passes behind.
  const share = 1 - smoothstep(1.5, 2.6, Math.abs(yaw));
  head.quaternion.multiply(turn.setFromAxisAngle(UP, limited(yaw * YAW_SHARE * share, MAX_YAW)));
  head.quaternion.multiply(turn.setFromAxisAngle(SIDE, limited(pitch * PITCH_SHARE * share, MAX_PITCH)));
  head.updateMatrixWorld(true);
}

function turnHand(rig: Rig, partner: Rig, joint: number, outward: Vector3): void {
  const wrist = rig.bones[joint]!;
  point.setFromMatrixPosition(wrist.matrixWorld);
  direction.set(0, 0, 0);
  let nearness = 0;
  for (const { wrist: theirs } of HANDS) {
    other.setFromMatrixPosition(partner.bones[theirs]!.matrixWorld).sub(point);
    const distance = other.length();
    // A weighted mean over both hands changes smoothly from one to the other; a direction needs some length.
    const weight = (1 - smoothstep(0.15, HOLD_DISTANCE, distance)) * smoothstep(0.02, 0.1, distance);
    direction.addScaledVector(other, weight / Math.max(distance, 1e-3));
    nearness = Math.max(nearness, weight);
  }
  if (nearness < 1e-3 || direction.lengthSq() < 1e-6) return;
  direction.applyQuaternion(worldToParent(rig, joint)).normalize();
  const bend = outward.angleTo(direction);
  if (bend < 1e-3) return;
  other.crossVectors(outward, direction);
  if (other.lengthSq() < 1e-8) return;
  const angle = MAX_BEND * Math.tanh((bend * nearness * (1 - smoothstep(1.6, 2.8, bend))) / MAX_BEND);
  wrist.quaternion.premultiply(turn.setFromAxisAngle(other.normalize(), angle));
  wrist.updateMatrixWorld(true);
}
