import { describe, expect, it, test } from 'vitest';
import { stepCounts } from '../../../../web/motion/beats/step-timing';
import { bringDown } from '../../../../web/motion/contact/bring-down';
import { besidePartner } from '../../../../web/motion/contact/beside-partner';
import { slowestFootSpeed } from '../../../../web/motion/contact/foot-contacts';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { madeStander } from '../../support/made-stander';
import { small } from '../../support/small-manifest';

const FPS = 30;
const STANDING = 0.03;

/** A dancer of 22 joints above each other, whose toes are so high above where they stand. */
function dancer(heights: readonly number[]): SolvedMotion {
  const frames = heights.length;
  const joint = (j: number): number => (j === J.left_foot || j === J.right_foot ? STANDING : 0.1 + j / 10);
  return {
    fps: FPS,
    frames,
    offsets: new Float32Array(JOINT_COUNT * 3),
    root: Float32Array.from(heights.flatMap((height) => [0, joint(0) + height, 0])),
    rotations: new Float32Array(frames * JOINT_COUNT * 4),
    positions: Float32Array.from(
      heights.flatMap((height) =>
        Array.from({ length: JOINT_COUNT }, (_, j) => [0, joint(j) + height, 0]).flat(),
      ),
    ),
    fitError: 0,
  };
}

const toeOf = ({ positions }: SolvedMotion, frame: number): number =>
  positions[(frame * JOINT_COUNT + J.left_foot) * 3 + 1]!;

describe('bringing a dancer down', () => {
  it('leaves standing, steps and a hop of 0.4 s as they are', () => {
    const hop = Array.from({ length: 90 }, (_, t) => Math.max(0, 0.25 - ((t - 45) / 12) ** 2));
    const motion = dancer(hop);
    expect(hop.filter((height) => height > 0)).toHaveLength(11);
    expect(bringDown(motion)).toBe(motion);
  });

  it('brings down who is off the floor for a second, whole and smoothly', () => {
    const motion = dancer(Array.from({ length: 90 }, (_, t) => (t >= 30 && t < 60 ? 0.1 : 0)));
    const down = bringDown(motion);
    expect(toeOf(down, 45)).toBeCloseTo(0.045, 3);
    expect(toeOf(down, 5)).toBeCloseTo(STANDING, 5);
    expect(down.root[45 * 3 + 1]! - toeOf(down, 45)).toBeCloseTo(
      motion.root[45 * 3 + 1]! - STANDING - 0.1,
      5,
    );
    const shift = Array.from({ length: 90 }, (_, t) => toeOf(motion, t) - toeOf(down, t));
    const steps = shift.slice(1).map((value, t) => Math.abs(value - shift[t]!));
    expect(Math.max(...steps)).toBeLessThan(0.015);
  });

  it('leaves who stands on one foot, the other in the air', () => {
    const motion = dancer(new Array<number>(90).fill(0));
    for (let t = 0; t < 90; t++) motion.positions[(t * JOINT_COUNT + J.right_foot) * 3 + 1]! += 0.3;
    expect(bringDown(motion)).toBe(motion);
  });

  it('lowers a hop from a floating stand by the stand alone', () => {
    const motion = dancer(Array.from({ length: 90 }, (_, t) => (t >= 42 && t < 48 ? 0.3 : 0.1)));
    expect(toeOf(bringDown(motion), 45)).toBeCloseTo(0.045 + 0.2, 3);
  });
});

test('beside a partner a dancer keeps out of their body, glides no faster than dancers go, stands and steps', () => {
  const partner = madeStander({ frames: 120 });
  // Off the floor all the time, and two metres away within a fifth of a second.
  const quick = madeStander({
    frames: 120,
    path: (t) => [0.05 + 2 * Math.min(1, Math.max(0, (t - 57) / 6)), 0],
  });
  const wild = {
    ...quick,
    root: quick.root.map((value, i) => (i % 3 === 1 ? value + 0.1 : value)),
    positions: quick.positions.map((value, i) => (i % 3 === 1 ? value + 0.1 : value)),
  };
  const kept = besidePartner(wild, partner, small.quality, stepCounts([], 120, FPS));
  for (const frame of [20, 100]) expect(toeOf(kept, frame)).toBeCloseTo(0.045, 3);
  expect(kept.root[0]! ** 2 + kept.root[2]! ** 2).toBeGreaterThan(0.15 ** 2);
  const speeds = Array.from(
    { length: 119 },
    (_, t) =>
      Math.hypot(kept.root[t * 3 + 3]! - kept.root[t * 3]!, kept.root[t * 3 + 5]! - kept.root[t * 3 + 2]!) *
      FPS,
  );
  expect(Math.max(...speeds)).toBeLessThan(1.501);
  // One foot stands while the body goes, to the beats where there are some.
  const standing = (motion: SolvedMotion): number[] =>
    [...slowestFootSpeed(motion).keys()].filter(
      (t) => speeds[t]! > 0.55 && slowestFootSpeed(motion)[t]! < 0.3,
    );
  const beats = [4, 17, 30, 43, 56, 69, 82, 95, 108];
  const danced = besidePartner(wild, partner, small.quality, stepCounts(beats, 120, FPS));
  expect(standing(kept).length).toBeGreaterThan(10);
  expect(standing(danced).length).toBeGreaterThan(10);
  expect(standing(danced)).not.toEqual(standing(kept));
});
