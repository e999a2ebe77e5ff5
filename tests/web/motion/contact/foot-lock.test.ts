import { describe, expect, test } from 'vitest';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { lockFeet } from '../../../../web/motion/contact/foot-lock';
import { contactWeights, leastSquaresShift } from '../../../../web/motion/contact/least-squares-shift';
import { type Limb, twoBoneIk } from '../../../../web/motion/contact/two-bone-ik';
import { contactIntervals } from '../../../../web/motion/contact/foot-contacts';
import { rotate } from '../../../../web/motion/math/quat';
import { FEET, J } from '../../../../web/motion/skeleton/skeleton';
import { solve } from '../../../../web/motion/fit/ik';
import { add, cross, distance, dot, length, sub, type Vec3 } from '../../../../web/motion/math/vec3';
import { madeDancer } from '../../support/made-dancer';
import { at, expectSound, KNEES, LEGS, moves, top } from '../../support/moved-joints';
import { eased, madeStander } from '../../support/made-stander';

/** Speeds over the floor in m/s, from each frame to the next. */
function slides(motion: SolvedMotion, joint: number): number[] {
  return Array.from({ length: motion.frames - 1 }, (_, frame) => {
    const [x, , z] = sub(at(motion, frame + 1, joint), at(motion, frame, joint));
    return Math.hypot(x, z) * motion.fps;
  });
}

/** Largest acceleration of a joint, m/s^2. */
function jolt(motion: SolvedMotion, joint: number): number {
  let most = 0;
  for (let frame = 1; frame < motion.frames - 1; frame++) {
    const [before, now, after] = [-1, 0, 1].map((by) => at(motion, frame + by, joint)) as [Vec3, Vec3, Vec3];
    most = Math.max(most, length(sub(sub(after, now), sub(now, before))) * motion.fps ** 2);
  }
  return most;
}

/** Carried to and fro by 5 cm, at up to 0.31 m/s. */
const sway = (frame: number): [number, number] => [
  0.05 * Math.sin(frame / 4.8),
  0.02 * Math.cos(frame / 4.8),
];

describe('locked feet', () => {
  test('do not slide, and the body above moves as before', () => {
    const free = madeStander({ frames: 120, path: sway });
    const locked = lockFeet(free);
    expectSound(free, locked);
    for (const joint of FEET) {
      expect(top(slides(free, joint))).toBeGreaterThan(0.3);
      expect(top(slides(locked, joint))).toBeLessThan(0.06);
      for (let frame = 0; frame < free.frames; frame++) {
        expect(at(locked, frame, joint)[1]).toBeCloseTo(at(free, frame, joint)[1], 5);
      }
    }
  });

  test('lock the standing foot and leave the lifted one free', () => {
    const lift = (frame: number): number => eased(frame, 30, 36) - eased(frame, 54, 60);
    const free = madeStander({ frames: 90, path: sway, lift });
    const locked = lockFeet(free);
    expectSound(free, locked);
    expect(top(slides(locked, J.right_foot))).toBeLessThan(0.06);
    const left = moves(free, locked, J.left_foot);
    expect(top(left)).toBeGreaterThan(0.02);
    expect(top(left.slice(42, 49))).toBeLessThan(0.001);
    expect(top(moves(free, locked, J.left_knee).slice(42, 49))).toBeLessThan(0.001);
    // The lock comes and goes without a jolt.
    for (const joint of [...FEET, ...KNEES]) expect(jolt(locked, joint)).toBeLessThan(jolt(free, joint) + 2);
  });

  test('are left alone where nothing slides', () => {
    const lift = (frame: number): number => eased(frame, 20, 30) - eased(frame, 40, 50);
    const free = madeStander({ frames: 80, lift });
    const locked = lockFeet(free);
    expectSound(free, locked);
    // A foot that is put down slides by a hair.
    for (const joint of [...FEET, ...KNEES]) expect(top(moves(free, locked, joint))).toBeLessThan(5e-4);
    const still = madeStander({ frames: 80 });
    const rested = lockFeet(still);
    for (const joint of [...FEET, ...KNEES]) expect(top(moves(still, rested, joint))).toBeLessThan(1e-6);
  });

  test('follow slowly where a slide goes on for long', () => {
    const free = madeStander({ frames: 120, path: (frame) => [0, 1.2 * eased(frame, 30, 90)] });
    const locked = lockFeet(free);
    expectSound(free, locked);
    for (const joint of FEET) {
      expect(top(moves(free, locked, joint))).toBeLessThan(0.14);
      expect(jolt(locked, joint)).toBeLessThan(jolt(free, joint) + 2);
    }
  });

  test('are released before a nearly straight leg would have to stretch, without a jump of the knee', () => {
    const path = (frame: number): [number, number] => [0, 0.15 * Math.sin(frame / 9)];
    const free = madeStander({ frames: 150, path, bend: 0.2 });
    const locked = lockFeet(free);
    expectSound(free, locked);
    for (const [hip, knee, ankle] of LEGS) {
      for (let frame = 0; frame < free.frames; frame++) {
        const long = distance(at(locked, frame, hip), at(locked, frame, ankle));
        expect(long).toBeLessThan(
          Math.max(0.985 * 0.83, distance(at(free, frame, hip), at(free, frame, ankle))) + 1e-3,
        );
      }
      expect(top(slides(locked, ankle))).toBeLessThan(0.7 * top(slides(free, ankle)));
      expect(jolt(locked, ankle)).toBeLessThan(jolt(free, ankle) + 2);
      expect(jolt(locked, knee)).toBeLessThan(10);
    }
  });

  test('keep the direction of the knees', () => {
    const locked = lockFeet(madeStander({ frames: 120, path: sway }));
    for (const [hip, knee, ankle] of LEGS) {
      for (let frame = 0; frame < locked.frames; frame++) {
        const thigh = sub(at(locked, frame, knee), at(locked, frame, hip));
        const hinge = cross(thigh, sub(at(locked, frame, ankle), at(locked, frame, knee)));
        expect(hinge[0]).toBeGreaterThan(0.95 * length(hinge));
      }
    }
  });

  test.each([1, 2, 3])('keep bone lengths and rotations of a solved dancer consistent, seed %i', (seed) => {
    const free = solve(madeDancer({ frames: 120, seed, spin: 0.3 * seed }));
    expectSound(free, lockFeet(free));
  });

  test('of one frame are as they were', () => {
    const free = madeStander({ frames: 1 });
    expectSound(free, lockFeet(free));
  });
});

describe('contact intervals', () => {
  test('are not split by a short faster slide, and leave out what never rests or is too short', () => {
    /** Carried on at these speeds in m/s, one a frame. */
    const carried = (speeds: readonly number[]) => {
      const positions = [0];
      for (const speed of speeds) positions.push(positions.at(-1)! + speed / 30);
      return contactIntervals(
        madeStander({ frames: positions.length, path: (t) => [positions[t]!, 0] }),
        J.left_foot,
      );
    };
    const row = (count: number, speed: number): number[] => new Array<number>(count).fill(speed);
    expect(carried([...row(5, 2), ...row(6, 0.3), ...row(3, 0.7), ...row(6, 0.3), ...row(5, 2)])).toEqual([
      { first: 5, last: 20 },
    ]);
    expect(carried([...row(9, 0.3), ...row(5, 2), ...row(15, 0.7), ...row(5, 2)])).toEqual([
      { first: 0, last: 9 },
    ]);
    expect(carried([...row(5, 2), ...row(3, 0.1), ...row(5, 2)])).toEqual([]);
    expect(carried([...row(5, 2), ...row(5, 0.1), ...row(5, 2)])).toEqual([{ first: 5, last: 10 }]);
  });

  test('are of toes up to 9 cm above the floor, and of ankles as much higher as they rest', () => {
    const stander = madeStander({ frames: 30 });
    for (const [height, count] of [
      [0.085, 1],
      [0.095, 0],
    ] as const) {
      const raised = height - at(stander, 0, J.left_foot)[1];
      const positions = stander.positions.map((value, i) => (i % 3 === 1 ? value + raised : value));
      for (const joint of [J.left_foot, J.left_ankle])
        expect(contactIntervals({ ...stander, positions }, joint)).toHaveLength(count);
    }
  });

  test('end where the foot is lifted', () => {
    const lift = (frame: number): number => eased(frame, 30, 40) - eased(frame, 50, 60);
    const intervals = contactIntervals(madeStander({ frames: 90, lift }), J.left_foot);
    expect(intervals).toHaveLength(2);
    expect(intervals[0]!.last).toBeGreaterThan(28);
    expect(intervals[0]!.last).toBeLessThan(32);
    expect(intervals[1]!.first).toBeGreaterThan(58);
    expect(intervals[1]!.last).toBe(89);
  });
});

describe('the least-squares shift', () => {
  test('has the least cost: a change of any frame raises it', () => {
    const positions = Float64Array.from(
      { length: 40 },
      (_, t) => 0.1 * Math.sin(t / 3) + 0.02 * Math.cos(t * t),
    );
    const contacts = [
      [{ first: 0, last: 12 }],
      [
        { first: 8, last: 15 },
        { first: 30, last: 39 },
      ],
    ];
    const tracks = [positions, positions.map((position) => position ** 2)].map((positions, joint) => ({
      positions,
      weights: contactWeights(40, contacts[joint]!),
    }));
    const zeroWeights = Float64Array.from({ length: 40 }, (_, t) => 1 + (t % 5));
    const cost = (shift: Float64Array): number => {
      let sum = 0;
      shift.forEach((s, t) => (sum += zeroWeights[t]! * s * s));
      tracks.forEach(({ positions: from }, joint) => {
        for (const { first, last } of contacts[joint]!) {
          for (let t = first; t < last; t++)
            sum += 100 * (from[t + 1]! + shift[t + 1]! - from[t]! - shift[t]!) ** 2;
        }
      });
      for (let t = 1; t < 39; t++) sum += 12 * (shift[t - 1]! - 2 * shift[t]! + shift[t + 1]!) ** 2;
      return sum;
    };
    const best = leastSquaresShift(tracks, zeroWeights);
    expect(top([...best])).toBeGreaterThan(0.01);
    for (let t = 0; t < 40; t++) {
      for (const by of [1e-4, -1e-4]) {
        const other = best.slice();
        other[t]! += by;
        expect(cost(other)).toBeGreaterThan(cost(best));
      }
    }
  });
});

describe('two-bone inverse kinematics', () => {
  const bentBy = (angle: number): Limb => ({
    start: [0.1, 0.9, 0],
    upper: [0, -0.42, 0],
    lower: [0.03, -0.4 * Math.cos(angle), -0.4 * Math.sin(angle)],
    hinge: [1, 0, 0],
  });
  const ankleOf = (leg: Limb, target: Vec3): Vec3 => {
    const { upper, lower } = twoBoneIk(leg, target);
    return add(leg.start, add(rotate(upper, leg.upper), rotate(lower, leg.lower)));
  };

  test.each([0.1, 0.6, 1.4])('brings the ankle to the target from a knee bent by %f', (angle) => {
    for (const target of [
      [0.1, 0.1, 0],
      [0.2, 0.2, 0.1],
      [0, 0.3, -0.2],
    ] as const) {
      expect(distance(ankleOf(bentBy(angle), target), target)).toBeLessThan(1e-9);
    }
  });

  test('stretches towards a target that is too far', () => {
    const target: Vec3 = [0.1, -0.3, 0.4];
    const leg = bentBy(0.6);
    const way = sub(ankleOf(leg, target), leg.start);
    expect(length(way)).toBeCloseTo(Math.hypot(0.82, 0.03), 3);
    expect(dot(way, sub(target, leg.start))).toBeCloseTo(length(way) * distance(target, leg.start), 9);
  });

  test('leaves a leg as it is whose ankle is at the target, even with a knee bent forwards by noise', () => {
    for (const angle of [-0.1, -0.01, 0.01, 0.5]) {
      const leg = bentBy(angle);
      const { upper, lower } = twoBoneIk(leg, add(leg.start, add(leg.upper, leg.lower)));
      for (const turn of [upper, lower]) expect(Math.abs(turn[3])).toBeGreaterThan(1 - 1e-9);
    }
  });

  test('does not jump where the knee passes through the straight leg', () => {
    const target: Vec3 = [0.15, 0.12, 0.05];
    const kneeAt = (angle: number): Vec3 => rotate(twoBoneIk(bentBy(angle), target).upper, [0, -0.42, 0]);
    for (let angle = -0.1; angle < 0.1; angle += 0.005) {
      expect(distance(kneeAt(angle), kneeAt(angle + 0.005))).toBeLessThan(0.003);
    }
  });
});
