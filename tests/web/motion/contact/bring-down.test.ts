import { describe, expect, it, test } from 'vitest';
import { bringDown } from '../../../../web/motion/contact/bring-down';
import { besidePartner } from '../../../../web/motion/contact/beside-partner';
import { shiftedLevel, type SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
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

/** As `dancer`, moved along x in each frame. */
function moved(motion: SolvedMotion, by: (frame: number) => number): SolvedMotion {
  return shiftedLevel(
    motion,
    Float64Array.from({ length: motion.frames }, (_, t) => by(t)),
    new Float64Array(motion.frames),
  );
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

test('beside a partner a dancer keeps out of their body, glides no faster than dancers go and stands', () => {
  const still = new Array<number>(120).fill(0);
  const partner = dancer(still);
  // Off the floor all the time, and two metres away within a fifth of a second.
  const wild = moved(dancer(still.map(() => 0.1)), (t) => 0.05 + 2 * Math.min(1, Math.max(0, (t - 57) / 6)));
  const kept = besidePartner(wild, partner, small.quality);
  expect(toeOf(kept, 60)).toBeCloseTo(0.045, 3);
  expect(kept.root[0]! ** 2 + kept.root[2]! ** 2).toBeGreaterThan(0.15 ** 2);
  const steps = Array.from({ length: 119 }, (_, t) =>
    Math.hypot(kept.root[t * 3 + 3]! - kept.root[t * 3]!, kept.root[t * 3 + 5]! - kept.root[t * 3 + 2]!),
  );
  expect(Math.max(...steps) * FPS).toBeLessThan(1.501);
});
