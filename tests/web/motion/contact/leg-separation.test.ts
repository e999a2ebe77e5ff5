import { describe, expect, it } from 'vitest';
import { separateLegs } from '../../../../web/motion/contact/leg-separation';
import { lockFeet, withFootLock } from '../../../../web/motion/contact/foot-lock';
import { aboutAxis, multiply, writeQuat } from '../../../../web/motion/math/quat';
import { segmentDistance } from '../../../../web/motion/math/segments';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { forwardKinematics } from '../../../../web/motion/skeleton/kinematics';
import { FEET, J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { at, expectSound, KNEES, moves, top } from '../../support/moved-joints';
import { eased, madeStander } from '../../support/made-stander';

const FRAMES = 90;
/** The left leg swings inwards until it is in the right one, and back, each in so many frames. */
function crossing(inwards: number, swing = 10): SolvedMotion {
  const still = madeStander({ frames: FRAMES });
  const rotations = still.rotations.slice();
  for (let frame = 0; frame < FRAMES; frame++) {
    const angle = inwards * eased(frame, 40 - swing, 40) * (1 - eased(frame, 41, 41 + swing));
    const bent = aboutAxis([1, 0, 0], -0.35);
    writeQuat(rotations, frame * JOINT_COUNT + J.left_hip, multiply(aboutAxis([0, 0, 1], -angle), bent));
  }
  return { ...still, rotations, positions: forwardKinematics(still.offsets, still.root, rotations) };
}

/** The distance between lower legs and feet in each frame, metres. */
function gaps(motion: SolvedMotion): number[] {
  return Array.from({ length: motion.frames }, (_, frame) => {
    const [left, right] = [
      [J.left_knee, J.left_ankle, J.left_foot],
      [J.right_knee, J.right_ankle, J.right_foot],
    ].map((leg) => Float64Array.from(leg.flatMap((joint) => [...at(motion, frame, joint)])));
    const pairs = [0, 3].flatMap((i) => [0, 3].map((j) => segmentDistance(left!, i, right!, j)));
    return Math.min(...pairs);
  });
}

describe('separateLegs', () => {
  it('returns a motion whose legs stay apart as it is', () => {
    const free = crossing(0);
    expect(separateLegs(free)).toBe(free);
  });

  it.each([
    [0.15, 10],
    [0.2, 10],
    [0.26, 10],
    [0.26, 4],
  ])('keeps a leg that swings inwards by %f radians in %i frames out of the other', (inwards, swing) => {
    const free = crossing(inwards, swing);
    expect(Math.min(...gaps(free))).toBeLessThan(0.07);
    const apart = separateLegs(free);
    expect(Math.min(...gaps(apart))).toBeGreaterThan(0.072);
    expectSound(free, apart);
    // No farther than is needed, and only around the encounter.
    const needed = 0.08 - Math.min(...gaps(free));
    for (const joint of FEET) expect(top(moves(free, apart, joint))).toBeLessThan(needed / 2 + 0.03);
    for (const joint of [...FEET, ...KNEES])
      expect(top(moves(free, apart, joint).slice(0, 15))).toBeLessThan(1e-6);
  });

  it.each([
    [0.26, 6],
    [0.3, 6],
  ])(
    'keeps apart legs that the foot lock brings together again, after %f radians in %i frames',
    (inwards, swing) => {
      const apart = separateLegs(crossing(inwards, swing));
      expect(Math.min(...gaps(lockFeet(apart)))).toBeLessThan(0.06);
      expect(Math.min(...gaps(withFootLock(apart)))).toBeGreaterThan(0.075);
    },
  );
});
