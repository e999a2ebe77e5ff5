import { describe, expect, it } from 'vitest';
import { Quaternion } from 'three';
import { JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { blendPose, createPose, samplePose } from '../../../../web/view/dancer/pose';
import { createRig } from '../../../../web/view/dancer/rig';
import { randomMotion } from '../../support/skeletons';

const motion = randomMotion(5, 3);
const quat = (values: Float32Array, joint: number, frame = 0): Quaternion =>
  new Quaternion().fromArray(values, (frame * JOINT_COUNT + joint) * 4);

describe('a sampled pose', () => {
  it('is the frame itself at a frame', () => {
    const pose = createPose();
    for (let frame = 0; frame < motion.frames; frame++) {
      samplePose(motion, frame / motion.fps, pose);
      for (let axis = 0; axis < 3; axis++)
        expect(pose.root[axis]).toBeCloseTo(motion.root[frame * 3 + axis]!, 5);
      for (let joint = 0; joint < JOINT_COUNT; joint++)
        expect(quat(pose.rotations, joint).angleTo(quat(motion.rotations, joint, frame))).toBeLessThan(2e-3);
    }
  });

  it('turns at constant speed along the shortest arc between frames', () => {
    const pose = createPose();
    for (const t of [0.25, 0.5, 0.8]) {
      samplePose(motion, (1 + t) / motion.fps, pose);
      for (let joint = 0; joint < JOINT_COUNT; joint++) {
        const [a, b] = [quat(motion.rotations, joint, 1), quat(motion.rotations, joint, 2)];
        expect(quat(pose.rotations, joint).length()).toBeCloseTo(1, 5);
        expect(quat(pose.rotations, joint).angleTo(a)).toBeCloseTo(t * a.angleTo(b), 3);
      }
    }
  });

  it('does not depend on the sign of a quaternion', () => {
    const flipped = { ...motion, rotations: motion.rotations.slice() };
    for (let i = 2 * JOINT_COUNT * 4; i < 3 * JOINT_COUNT * 4; i++) flipped.rotations[i]! *= -1;
    const [a, b] = [createPose(), createPose()];
    samplePose(motion, 1.5 / motion.fps, a);
    samplePose(flipped, 1.5 / motion.fps, b);
    for (let joint = 0; joint < JOINT_COUNT; joint++)
      expect(quat(a.rotations, joint).angleTo(quat(b.rotations, joint))).toBeLessThan(2e-3);
  });

  it('holds the first and the last frame outside the dance', () => {
    const [at, out] = [createPose(), createPose()];
    samplePose(motion, 0, at);
    samplePose(motion, -3, out);
    expect(out).toEqual(at);
    samplePose(motion, (motion.frames - 1) / motion.fps, at);
    samplePose(motion, 99, out);
    expect(out.root).toEqual(at.root);
    const one = randomMotion(1, 9);
    samplePose(one, 0.4, out);
    expect([...out.root]).toEqual([...one.root]);
  });
});

describe('the rig', () => {
  it('puts every joint where forward kinematics has it, at the bones of its own skeleton', () => {
    const rig = createRig();
    rig.bind(randomMotion(1).offsets);
    const long = randomMotion(
      4,
      11,
      randomMotion(1).offsets.map((value) => value * 1.07),
    );
    for (const dance of [motion, long]) {
      rig.fit(dance.offsets);
      const pose = createPose();
      const joints = new Float32Array(JOINT_COUNT * 3);
      for (let frame = 0; frame < dance.frames; frame++) {
        samplePose(dance, frame / dance.fps, pose);
        rig.apply(pose);
        rig.jointPositions(joints);
        for (let i = 0; i < joints.length; i++)
          expect(Math.abs(joints[i]! - dance.positions[frame * JOINT_COUNT * 3 + i]!)).toBeLessThan(2e-5);
      }
    }
  });
});

it('one pose blends into another along the shortest arc', () => {
  const about = (angle: number) => [0, Math.sin(angle / 2), 0, Math.cos(angle / 2)];
  const posed = (x: number, quaternion: readonly number[]) => {
    const pose = createPose();
    pose.root.set([x, 1, 0]);
    for (let joint = 0; joint < 22; joint++) pose.rotations.set(quaternion, joint * 4);
    return pose;
  };
  // The same turn with its sign the other way: a straight mix would pass through zero.
  const to = posed(
    2,
    about(1).map((value) => -value),
  );
  for (const [t, angle] of [
    [0, 0],
    [0.5, 0.5],
    [1, 1],
  ] as const) {
    const pose = posed(0, about(0));
    blendPose(pose, to, t);
    expect(pose.root[0]).toBeCloseTo(2 * t, 6);
    const dot = about(angle).reduce((sum, value, i) => sum + value * pose.rotations[84 + i]!, 0);
    expect(Math.abs(dot)).toBeCloseTo(1, 6);
  }
});
