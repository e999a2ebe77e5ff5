/** The same dance by a body of another size: feet stay where they stand, joined hands stay joined. */
import { describe, expect, it } from 'vitest';
import { resized } from '../../../../web/motion/contact/body-size';
import type { MotionClip } from '../../../../web/motion/skeleton/clip';
import { J, JOINT_COUNT, PARENTS, SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { aboutAxis, writeQuat } from '../../../../web/motion/math/quat';
import { distance, lerp, readVec, type Vec3 } from '../../../../web/motion/math/vec3';
import { madeDancer } from '../../support/made-dancer';

const TOE_REST = 0.03;
const clip: MotionClip = madeDancer({ frames: 60 });
/** A partner whose hands are out of reach. */
const far: MotionClip = { ...clip, positions: clip.positions.map((value) => value + 10) };

const at = ({ positions }: MotionClip, frame: number, joint: number) =>
  readVec(positions, frame * JOINT_COUNT + joint);
const frames = [...Array(clip.frames).keys()];

describe('resized', () => {
  it('returns the clip itself for the size that it has', () => {
    expect(resized(clip, 1, far, TOE_REST)).toBe(clip);
  });

  it.each([0.8, 0.95, 1.1, 1.3])('multiplies every bone by %f', (factor) => {
    const other = resized(clip, factor, far, TOE_REST);
    for (const frame of frames)
      for (let joint = 1; joint < JOINT_COUNT; joint++) {
        const bone = (of: MotionClip) => distance(at(of, frame, joint), at(of, frame, PARENTS[joint]!));
        expect(bone(other), SMPL22[joint]).toBeCloseTo(factor * bone(clip), 5);
      }
  });

  it('keeps the pelvis and the middle of each foot above their places on the floor', () => {
    const other = resized(clip, 1.2, far, TOE_REST);
    for (const frame of frames) {
      const [before, after] = [at(clip, frame, J.pelvis), at(other, frame, J.pelvis)];
      expect([after[0], after[2]]).toEqual([before[0], before[2]]);
      for (const side of ['left', 'right'] as const)
        for (const axis of [0, 2] as const) {
          const middle = (of: MotionClip) =>
            at(of, frame, J[`${side}_ankle`])[axis] + at(of, frame, J[`${side}_foot`])[axis];
          expect(middle(other)).toBeCloseTo(middle(clip), 5);
        }
    }
  });

  it('keeps toes that rest on the floor at their height', () => {
    const toe = at(clip, 0, J.left_foot)[1];
    const other = resized(clip, 1.2, far, toe);
    expect(at(other, 0, J.left_foot)[1]).toBeCloseTo(toe, 6);
  });

  it('keeps a hand at the hand that it holds, and moves one that holds none with the body', () => {
    const held = 30;
    // A partner whose left hand is at the dancer's right one, and whose other joints are far away.
    const partner = { ...far, positions: far.positions.slice() };
    for (const frame of frames) {
      const from = (frame * JOINT_COUNT + J.right_wrist) * 3;
      const hand = clip.positions.subarray(from, from + 3);
      partner.positions.set(hand, (frame * JOINT_COUNT + J.left_wrist) * 3);
    }
    const other = resized(clip, 1.06, partner, TOE_REST);
    expect(distance(at(other, held, J.right_wrist), at(clip, held, J.right_wrist))).toBeLessThan(0.005);
    expect(distance(at(other, held, J.left_wrist), at(clip, held, J.left_wrist))).toBeGreaterThan(0.02);
  });

  it('lets a hand go gradually as the other moves away', () => {
    /** How much of its way with the body the right hand makes where the partner's is so far behind it. */
    const share = (metres: number): number => {
      const partner = { ...far, positions: far.positions.slice() };
      for (const frame of frames) {
        const [x, y, z] = at(clip, frame, J.right_wrist);
        partner.positions.set([x, y, z - metres], (frame * JOINT_COUNT + J.left_wrist) * 3);
      }
      const [held, free] = [partner, far].map((other) =>
        at(resized(clip, 1.06, other, TOE_REST), 30, J.right_wrist),
      ) as [Vec3, Vec3];
      return 1 - distance(held, free) / distance(at(clip, 30, J.right_wrist), free);
    };
    expect(share(0.1)).toBeLessThan(0.05);
    expect(share(0.2)).toBeLessThan(0.12);
    expect(share(0.3)).toBeCloseTo(0.5, 1);
    expect(share(0.4)).toBeGreaterThan(0.9);
    expect(share(0.5)).toBe(1);
  });

  it('takes up and lets go a hand over some frames, however fast the other one comes', () => {
    const partner = { ...far, positions: far.positions.slice() };
    for (const frame of frames.slice(30))
      partner.positions.set(at(clip, frame, J.right_wrist), (frame * JOINT_COUNT + J.left_wrist) * 3);
    const free = resized(clip, 1.2, far, TOE_REST);
    const other = resized(clip, 1.2, partner, TOE_REST);
    const moved = frames.map((frame) =>
      distance(at(other, frame, J.right_wrist), at(free, frame, J.right_wrist)),
    );
    const steps = moved.slice(1).map((value, i) => Math.abs(value - moved[i]!));
    expect(moved[50]).toBeGreaterThan(0.08);
    expect(Math.max(...steps)).toBeLessThan(0.25 * moved[50]!);
  });

  it('moves the hand of a folded arm with the body, since the arm would swing round its shoulder', () => {
    const folded = (angle: number): number => {
      const bent = madeDancer({ frames: 40, bend: () => angle });
      const partner = { ...bent, positions: bent.positions.map((value) => value + 10) };
      for (let frame = 0; frame < 40; frame++)
        partner.positions.set(at(bent, frame, J.right_wrist), (frame * JOINT_COUNT + J.left_wrist) * 3);
      const away = { ...bent, positions: bent.positions.map((value) => value + 10) };
      const [held, free] = [partner, away].map((other) =>
        at(resized(bent, 1.2, other, TOE_REST), 20, J.right_wrist),
      ) as [Vec3, Vec3];
      return distance(held, free);
    };
    expect(folded(2.9)).toBe(0);
    expect(folded(0.6)).toBeGreaterThan(0.04);
  });

  it('lets a hand go that a much smaller body cannot reach', () => {
    const partner = { ...far, positions: far.positions.slice() };
    for (const frame of frames)
      partner.positions.set(at(clip, frame, J.right_wrist), (frame * JOINT_COUNT + J.left_wrist) * 3);
    const moved = (factor: number): number => {
      const [held, free] = [partner, far].map((other) =>
        at(resized(clip, factor, other, TOE_REST), 30, J.right_wrist),
      ) as [Vec3, Vec3];
      return distance(held, free);
    };
    expect(moved(0.9)).toBeGreaterThan(0.02);
    expect(moved(0.3)).toBe(0);
  });

  it('bends legs that were straight forwards, and stretches none fully to stay where it stood', () => {
    // Straight legs, the feet apart.
    const { offsets } = madeDancer({ frames: 1 });
    const rotations = new Float32Array(JOINT_COUNT * 4).map((_, i) => (i % 4 === 3 ? 1 : 0));
    writeQuat(rotations, J.left_hip, aboutAxis([0, 0, 1], 0.5));
    writeQuat(rotations, J.right_hip, aboutAxis([0, 0, 1], -0.5));
    const straight: MotionClip = {
      fps: 30,
      frames: 1,
      positions: forwardKinematics(offsets, Float32Array.of(0, 0.9, 0), rotations),
    };
    const tall = resized(straight, 1.2, far, TOE_REST);
    const bent = { ...straight, positions: madeDancer({ frames: 1 }).positions };
    const small = resized(bent, 0.6, bent, TOE_REST);
    for (const side of ['left', 'right'] as const) {
      const [hip, knee, ankle] = [J[`${side}_hip`], J[`${side}_knee`], J[`${side}_ankle`]];
      const middle = lerp(at(tall, 0, hip), at(tall, 0, ankle), 0.5);
      expect(at(tall, 0, knee)[2] - middle[2]).toBeGreaterThan(0.1);
      const limbs = [
        [hip, knee, ankle],
        [J[`${side}_shoulder`], J[`${side}_elbow`], J[`${side}_wrist`]],
      ] as const;
      for (const [start, joint, end] of limbs) {
        const bones = [start, end].map((other) => distance(at(small, 0, joint), at(small, 0, other)));
        const extension = distance(at(small, 0, start), at(small, 0, end)) / (bones[0]! + bones[1]!);
        expect(extension).toBeLessThan(0.99);
      }
    }
  });

  it('moves as smoothly as before', () => {
    const jump = (of: MotionClip) =>
      Math.max(
        ...frames
          .slice(1)
          .flatMap((frame) =>
            SMPL22.map((_, joint) => distance(at(of, frame, joint), at(of, frame - 1, joint))),
          ),
      );
    for (const factor of [0.8, 1.3])
      expect(jump(resized(clip, factor, clip, TOE_REST))).toBeLessThan(2 * jump(clip));
  });
});
