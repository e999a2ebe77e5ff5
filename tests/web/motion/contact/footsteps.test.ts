import { describe, expect, test } from 'vitest';
import { stepCounts } from '../../../../web/motion/beats/step-timing';
import { slowestFootSpeed } from '../../../../web/motion/contact/foot-contacts';
import { withFootLock } from '../../../../web/motion/contact/foot-lock';
import { withFootsteps } from '../../../../web/motion/contact/footsteps';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { FEET, J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { eased, madeStander } from '../../support/made-stander';
import { at, expectSound, moves, top } from '../../support/moved-joints';

/** Who is carried at so many m/s from frame 60 to 150 of 240, and stands before and after. */
const carried = (speed: number, lift = 0): SolvedMotion =>
  madeStander({
    frames: 240,
    lift: () => lift,
    path: (frame) => [(speed / 30) * Math.min(90, Math.max(0, frame - 60)), 0],
  });
/** Steps of a third of a second. */
const STEPS = stepCounts([], 240, 30);
const share = (values: ArrayLike<number>, fits: (value: number) => boolean): number =>
  Array.from(values).filter(fits).length / values.length;

describe('a dancer who slides on both feet', () => {
  const free = carried(1.2);
  const stepping = withFootsteps(free, STEPS);

  test('steps: one foot stands while the other is lifted, in turn', () => {
    expectSound(free, stepping);
    const under = (motion: SolvedMotion): Float64Array => slowestFootSpeed(motion).subarray(66, 144);
    expect(Math.min(...under(free))).toBeGreaterThan(1.19);
    expect(share(under(stepping), (speed) => speed < 0.2)).toBeGreaterThan(0.6);
    expect(share(under(stepping), (speed) => speed < 0.6)).toBeGreaterThan(0.9);
    const rise = (joint: number): number[] =>
      Array.from({ length: 78 }, (_, i) => at(stepping, 66 + i, joint)[1] - at(free, 66 + i, joint)[1]);
    const [left, right] = [rise(J.left_foot), rise(J.right_foot)];
    for (const lift of [left, right]) {
      expect(top(lift)).toBeCloseTo(0.05, 3);
      expect(Math.min(...lift)).toBeCloseTo(0, 5);
      // As long as the foot stands, it is down: half of the time.
      expect(Math.abs(share(lift, (height) => height < 1e-4) - 0.5)).toBeLessThan(0.1);
    }
    expect(top(left.map((height, i) => Math.min(height, right[i]!)))).toBeLessThan(1e-4);
  });

  test('steps from place to place as far as the body travels', () => {
    const stands = Array.from({ length: 78 }, (_, i) => 66 + i).filter(
      (frame) =>
        Math.abs(at(stepping, frame + 1, J.left_foot)[0] - at(stepping, frame, J.left_foot)[0]) < 0.005,
    );
    const places = stands.map((frame) => at(stepping, frame, J.left_foot)[0]);
    const steps = places.slice(1).map((place, i) => place - places[i]!);
    const long = steps.filter((step) => step > 0.1);
    // A cycle of 20 frames at 1.2 m/s.
    expect(long.length).toBeGreaterThanOrEqual(4);
    expect(long.reduce((sum, step) => sum + step, 0) / long.length).toBeCloseTo(0.8, 1);
  });

  test('stands on a foot that would hover, and lifts it no higher than the other', () => {
    const hovering = carried(1.2, 0.4);
    const heights = (motion: SolvedMotion): number[] =>
      Array.from({ length: 78 }, (_, i) => at(motion, 66 + i, J.left_foot)[1]);
    expect(Math.min(...heights(hovering))).toBeGreaterThan(0.1);
    const down = withFootsteps(hovering, STEPS);
    expectSound(hovering, down);
    expect(share(heights(down), (height) => height < 0.05)).toBeGreaterThan(0.45);
    expect(Math.min(...heights(down))).toBeGreaterThan(0.04);
    expect(top(heights(down))).toBeLessThan(0.1);
    expect(share(heights(withFootLock(down)), (height) => height < 0.05)).toBeGreaterThan(0.45);
  });

  test('steps under the foot lock', () => {
    const speeds = (motion: SolvedMotion): Float64Array => slowestFootSpeed(motion).subarray(66, 144);
    const locked = withFootLock(stepping);
    expectSound(free, locked);
    expect(share(speeds(locked), (speed) => speed < 0.2)).toBeGreaterThan(0.5);
  });

  test('is left alone where they stand', () => {
    for (const joint of FEET) {
      const moved = moves(free, stepping, joint);
      expect(top(moved.slice(0, 20))).toBeLessThan(0.001);
      expect(top(moved.slice(212))).toBe(0);
    }
  });

  test('steps in a part as in the whole', () => {
    for (const from of [60, 67]) {
      const to = from + 100;
      const cut = (values: Float32Array, width: number): Float32Array =>
        values.slice(from * width, to * width);
      const part = withFootsteps(
        {
          ...free,
          frames: to - from,
          root: cut(free.root, 3),
          rotations: cut(free.rotations, 4 * JOINT_COUNT),
          positions: cut(free.positions, 3 * JOINT_COUNT),
        },
        STEPS.subarray(from, to),
      );
      for (const joint of FEET)
        for (let frame = 40; frame < 60; frame++)
          at(part, frame, joint).forEach((value, axis) =>
            expect(value).toBeCloseTo(at(stepping, from + frame, joint)[axis]!, 3),
          );
    }
  });

  test('puts its feet down on the beats of the song', () => {
    const beats = [3, 16, 29, 42, 55, 68, 81, 94, 107, 120, 133, 146, 159];
    const danced = withFootsteps(free, stepCounts(beats, 240, 30));
    expectSound(free, danced);
    const left = Array.from({ length: 78 }, (_, i) => at(danced, 66 + i, J.left_foot)[1]);
    const lift = left.map((height, i) => height - at(free, 66 + i, J.left_foot)[1]);
    const landings = [...lift.keys()].filter((i) => i > 0 && lift[i]! < 0.001 && lift[i - 1]! > 0.001);
    // Every second beat is the other foot's.
    expect(landings.map((i) => 66 + i)).toEqual([81, 107, 133]);
  });

  test('steps nearly alike when the motion changes little', () => {
    const other = withFootsteps(carried(1.203), STEPS);
    for (const joint of FEET) expect(top(moves(stepping, other, joint))).toBeLessThan(0.02);
  });
});

describe('nothing is changed', () => {
  test('in a slow slide, which the foot lock holds', () => {
    const slow = carried(0.49);
    expect(withFootsteps(slow, STEPS)).toBe(slow);
  });

  test('where one foot stands and the other is quick', () => {
    const kick = madeStander({
      frames: 90,
      lift: (frame) =>
        eased(frame, 30, 33) - eased(frame, 34, 37) + eased(frame, 50, 53) - eased(frame, 54, 57),
    });
    expect(withFootsteps(kick, STEPS)).toBe(kick);
  });

  test('in a motion of one frame', () => {
    const one = madeStander({ frames: 1 });
    expect(withFootsteps(one, STEPS)).toBe(one);
  });
});
