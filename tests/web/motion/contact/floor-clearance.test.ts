import { describe, expect, it } from 'vitest';
import { liftFeet } from '../../../../web/motion/contact/floor-clearance';
import { lowered, type SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { aboutAxis, writeQuat } from '../../../../web/motion/math/quat';
import { FEET, J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { at, expectSound, moves, top } from '../../support/moved-joints';
import { eased, madeStander } from '../../support/made-stander';

const FRAMES = 60;
const still = madeStander({ frames: FRAMES });
/** 0, then 1 for a third of a second, then 0. */
const dip = (frame: number): number => eased(frame, 15, 25) * (1 - eased(frame, 35, 45));
const HEEL = -still.offsets[J.left_foot * 3 + 1]!;

/** The lowest height of a joint, metres. */
const lowest = (motion: SolvedMotion, joint: number): number =>
  Math.min(...Array.from({ length: motion.frames }, (_, frame) => at(motion, frame, joint)[1]));

describe('liftFeet', () => {
  it('leaves feet that stand on the floor', () => {
    const lifted = liftFeet(still);
    for (const joint of FEET) expect(top(moves(still, lifted, joint))).toBeLessThan(1e-3);
  });

  it('brings feet that sink into the floor up to it, and leaves the body', () => {
    const sunk = lowered(
      still,
      Float64Array.from({ length: FRAMES }, (_, frame) => 0.04 * dip(frame)),
    );
    expect(lowest(sunk, J.left_foot)).toBeLessThan(0);
    const lifted = liftFeet(sunk);
    for (const toe of [J.left_foot, J.right_foot]) expect(lowest(lifted, toe)).toBeGreaterThan(0.028);
    for (const ankle of [J.left_ankle, J.right_ankle])
      expect(lowest(lifted, ankle)).toBeGreaterThan(0.028 + HEEL);
    expectSound(sunk, lifted);
  });

  it('turns a foot whose heel alone is in the floor about its ball', () => {
    const rotations = still.rotations.slice();
    // A leg that is longer by a straighter knee, and toes that are raised to where they were.
    for (let frame = 0; frame < FRAMES; frame++) {
      const [bend, raise] = [0.35 - 0.1 * dip(frame), 0.5 * dip(frame)];
      const turn = (joint: number, angle: number): void =>
        writeQuat(rotations, frame * JOINT_COUNT + joint, aboutAxis([1, 0, 0], angle));
      turn(J.left_hip, -bend);
      turn(J.left_knee, 2 * bend);
      turn(J.left_ankle, -bend - raise);
    }
    const heeled = {
      ...still,
      rotations,
      positions: forwardKinematics(still.offsets, still.root, rotations),
    };
    expect(lowest(heeled, J.left_ankle)).toBeLessThan(0.02 + HEEL);
    const lifted = liftFeet(heeled);
    expect(lowest(lifted, J.left_ankle)).toBeGreaterThan(0.028 + HEEL);
    expect(top(moves(heeled, lifted, J.left_foot))).toBeLessThan(0.015);
    expectSound(heeled, lifted);
  });
});
