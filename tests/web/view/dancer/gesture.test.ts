import { describe, expect, it } from 'vitest';
import { Vector3 } from 'three';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { gesture, levelHead } from '../../../../web/view/dancer/gesture';
import { createPose, samplePose } from '../../../../web/view/dancer/pose';
import { createRig, type Rig } from '../../../../web/view/dancer/rig';
import { person, randomMotion } from '../../support/skeletons';

/** A dancer in the T-pose at (x, z), the root at a height in metres. */
function standing(x: number, z: number, height = 0.95): Rig {
  const rig = createRig();
  rig.fit(person());
  const pose = createPose();
  for (let joint = 0; joint < JOINT_COUNT; joint++) pose.rotations[joint * 4 + 3] = 1;
  pose.root.set([x, height, z]);
  rig.apply(pose);
  return rig;
}

const axisOf = (rig: Rig, joint: number, axis: Vector3): Vector3 =>
  axis.clone().transformDirection(rig.bones[joint]!.matrixWorld);
const FORWARD = new Vector3(0, 0, 1);

describe('gestures', () => {
  it('leave every joint where the motion has it', () => {
    const [a, b] = [randomMotion(6, 21), randomMotion(6, 22)];
    const [rigA, rigB] = [createRig(), createRig()];
    const pose = createPose();
    for (let frame = 0; frame < 6; frame++) {
      for (const [rig, motion] of [
        [rigA, a],
        [rigB, b],
      ] as const) {
        rig.fit(motion.offsets);
        samplePose(motion, frame / 30, pose);
        rig.apply(pose);
      }
      levelHead(rigA);
      gesture(rigA, rigB);
      const joints = rigA.jointPositions(new Float32Array(JOINT_COUNT * 3));
      for (let i = 0; i < joints.length; i++)
        expect(Math.abs(joints[i]! - a.positions[frame * JOINT_COUNT * 3 + i]!)).toBeLessThan(2e-5);
    }
  });

  it.each([
    ['forward', new Vector3(1, 0, 0)],
    ['backward', new Vector3(-1, 0, 0)],
    ['sideways', new Vector3(0, 0, 1)],
  ])('hold the head level on a trunk that leans %s, wherever the dancer faces', (_, axis) => {
    for (const heading of [0, 2, -2.8]) {
      const rig = standing(0, 0);
      const [neck, head] = [rig.bones[J.neck]!, rig.bones[J.head]!];
      rig.root.quaternion.setFromAxisAngle(new Vector3(0, 1, 0), heading);
      neck.quaternion.setFromAxisAngle(axis, 0.3);
      rig.root.updateMatrixWorld(true);
      const before = axisOf(rig, J.head, FORWARD);
      levelHead(rig);
      const [gaze, up] = [axisOf(rig, J.head, FORWARD), axisOf(rig, J.head, new Vector3(0, 1, 0))];
      expect(up.y).toBeGreaterThan(Math.cos(0.1));
      expect(Math.abs(gaze.y)).toBeLessThan(0.1);
      expect(Math.atan2(gaze.x, gaze.z)).toBeCloseTo(Math.atan2(before.x, before.z), 1);
      expect(neck.quaternion.angleTo(head.quaternion)).toBeGreaterThan(0.3);
    }
  });

  it('do not turn a head over that looks at the floor', () => {
    const rig = standing(0, 0);
    rig.bones[J.neck]!.quaternion.setFromAxisAngle(new Vector3(1, 0, 0), 1.5);
    rig.root.updateMatrixWorld(true);
    levelHead(rig);
    expect(axisOf(rig, J.head, FORWARD).y).toBeLessThan(-0.9);
  });

  it('turn the head towards the partner, part of the way', () => {
    const rig = standing(0, 0);
    gesture(rig, standing(1, 1));
    const gaze = axisOf(rig, J.head, FORWARD);
    const yaw = Math.atan2(gaze.x, gaze.z);
    expect(yaw).toBeGreaterThan(0.3);
    expect(yaw).toBeLessThan(Math.PI / 4);
  });

  it('lift the head to a taller partner, and lower it to a smaller one', () => {
    for (const [height, up] of [
      [1.4, 1],
      [0.5, -1],
    ] as const) {
      const rig = standing(0, 0);
      gesture(rig, standing(0, 1, height));
      expect(up * axisOf(rig, J.head, FORWARD).y).toBeGreaterThan(0.05);
    }
  });

  it('do not turn the head to a partner behind', () => {
    const rig = standing(0, 0);
    gesture(rig, standing(0.1, -1));
    expect(axisOf(rig, J.head, FORWARD).z).toBeGreaterThan(0.99);
  });

  it('turn a hand towards a hand nearby and leave it alone otherwise', () => {
    const [near, far, touching] = [standing(0, 0), standing(0, 0), standing(0, 0)];
    gesture(near, standing(0, 0.2));
    gesture(far, standing(0, 2));
    const twisted = standing(0, 0);
    for (const wrist of [J.left_wrist, J.right_wrist])
      twisted.bones[wrist]!.quaternion.setFromAxisAngle(new Vector3(1, 0, 0), Math.PI / 2);
    twisted.root.updateMatrixWorld(true);
    gesture(twisted, standing(0, 0.2));
    // Nearer than a direction can be told.
    gesture(touching, standing(0, 0.01));
    for (const [wrist, outwards] of [
      [J.left_wrist, new Vector3(1, 0, 0)],
      [J.right_wrist, new Vector3(-1, 0, 0)],
    ] as const) {
      for (const turned of [near, twisted]) expect(axisOf(turned, wrist, outwards).z).toBeGreaterThan(0.3);
      for (const still of [far, touching])
        expect(axisOf(still, wrist, outwards).dot(outwards)).toBeGreaterThan(0.9999);
    }
  });
});
