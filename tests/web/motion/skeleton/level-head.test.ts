import { describe, expect, it } from 'vitest';
import { levelled, withLevelHead } from '../../../../web/motion/skeleton/level-head';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import {
  aboutAxis,
  multiply,
  type Quat,
  readQuat,
  rotate,
  writeQuat,
} from '../../../../web/motion/math/quat';
import { J, JOINT_COUNT, PARENTS } from '../../../../web/motion/skeleton/skeleton';
import { madeDancer } from '../../support/made-dancer';

/** Angle of the head's gaze above the horizon, radians. */
const pitch = (head: Quat): number => Math.asin(rotate(head, [0, 0, 1])[1]);
const heading = (head: Quat): number => {
  const [x, , z] = rotate(head, [0, 0, 1]);
  return Math.atan2(x, z);
};

describe('a level head', () => {
  it.each([
    [0.3, 0],
    [-0.3, 2],
    [0.2, -2.8],
  ])('on a neck that is tilted by %f and faces %f looks at the horizon, the same way', (tilt, faces) => {
    const neck = multiply(aboutAxis([0, 1, 0], faces), aboutAxis([1, 0, 0], tilt));
    const head = levelled(neck);
    expect(Math.abs(pitch(head))).toBeLessThan(0.2 * Math.abs(tilt));
    expect(heading(head)).toBeCloseTo(heading(neck), 2);
  });

  it('is turned by at most 35 degrees, and not at all where it looks straight up', () => {
    expect(pitch(levelled(aboutAxis([1, 0, 0], -1.1)))).toBeGreaterThan(1.1 - 0.61);
    const up = aboutAxis([1, 0, 0], -1.5);
    expect(pitch(levelled(up))).toBeCloseTo(1.5, 6);
  });

  it('is written into a motion without moving a joint', () => {
    const made = madeDancer({ frames: 40, seed: 3 });
    const rotations = made.rotations.slice();
    for (let frame = 0; frame < made.frames; frame++)
      writeQuat(rotations, frame * JOINT_COUNT + J.neck, aboutAxis([1, 0, 0], -0.5));
    const motion = { ...made, rotations, positions: forwardKinematics(made.offsets, made.root, rotations) };
    const level = withLevelHead(motion);
    expect(level.positions).toBe(motion.positions);
    expect(forwardKinematics(level.offsets, level.root, level.rotations)).toEqual(
      forwardKinematics(motion.offsets, motion.root, motion.rotations),
    );
    const headOf = ({ rotations: all }: SolvedMotion, frame: number): Quat => {
      let turn = readQuat(all, frame * JOINT_COUNT + J.head);
      for (let joint = PARENTS[J.head]!; joint >= 0; joint = PARENTS[joint]!)
        turn = multiply(readQuat(all, frame * JOINT_COUNT + joint), turn);
      return turn;
    };
    for (let frame = 0; frame < motion.frames; frame++)
      expect(Math.abs(pitch(headOf(level, frame)))).toBeLessThan(
        0.5 * Math.abs(pitch(headOf(motion, frame))),
      );
  });
});
