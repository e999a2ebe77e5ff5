import { describe, expect, it } from 'vitest';
import { bringDown } from '../../../../web/motion/contact/bring-down';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';

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

  it('lowers a hop from a floating stand by the stand alone', () => {
    const motion = dancer(Array.from({ length: 90 }, (_, t) => (t >= 42 && t < 48 ? 0.3 : 0.1)));
    expect(toeOf(bringDown(motion), 45)).toBeCloseTo(0.045 + 0.2, 3);
  });
});
