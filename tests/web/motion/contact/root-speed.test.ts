import { describe, expect, it } from 'vitest';
import { limitRootSpeed } from '../../../../web/motion/contact/root-speed';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';

const FPS = 30;
const RULE = { ratio: 1.5, reach: 0.5, free_speed: 1.5 };

/** A dancer of 22 joints above each other whose root is at these places along x. */
function dancer(xs: readonly number[]): SolvedMotion {
  const frames = xs.length;
  return {
    fps: FPS,
    frames,
    offsets: new Float32Array(JOINT_COUNT * 3),
    root: Float32Array.from(xs.flatMap((x) => [x, 1, 0])),
    rotations: new Float32Array(frames * JOINT_COUNT * 4),
    positions: Float32Array.from(
      xs.flatMap((x) => Array.from({ length: JOINT_COUNT }, (_, j) => [x, 1 + j / 10, 0]).flat()),
    ),
    fitError: 0,
  };
}

const line = (frames: number, speed: number): number[] =>
  Array.from({ length: frames }, (_, t) => (t * speed) / FPS);

function speeds({ root, frames }: SolvedMotion): number[] {
  return Array.from({ length: frames - 1 }, (_, t) => Math.abs(root[t * 3 + 3]! - root[t * 3]!) * FPS);
}

describe('the limit of the root speed', () => {
  it('returns a motion within it as it is', () => {
    const motion = dancer(line(90, 1.4));
    expect(limitRootSpeed(motion, dancer(line(90, 0)), RULE)).toBe(motion);
  });

  it('slows a leap of two metres in 0.2 s beside a standing partner down to 1.5 m/s, around its middle', () => {
    const xs = Array.from({ length: 120 }, (_, t) => 2 * Math.min(1, Math.max(0, (t - 57) / 6)));
    const slowed = limitRootSpeed(dancer(xs), dancer(line(120, 0)), RULE);
    expect(Math.max(...speeds(slowed))).toBeLessThan(1.501);
    expect(slowed.root[0]).toBe(0);
    expect(slowed.root.at(-3)).toBeCloseTo(2, 5);
    expect(slowed.root[60 * 3]).toBeCloseTo(1, 1);
    const head = (t: number): number => slowed.positions[(t * JOINT_COUNT + 15) * 3]!;
    expect(head(50)).toBeCloseTo(slowed.root[50 * 3]!, 5);
  });

  it('lets the root be half as fast again as the partner within half a second', () => {
    const partner = dancer(line(120, 2));
    const slowed = limitRootSpeed(dancer(line(120, 4)), partner, RULE);
    expect(Math.max(...speeds(slowed))).toBeCloseTo(3, 3);
  });

  it('follows a partner who was fast less than half a second ago, but not one who was fast long ago', () => {
    /** Stands, goes at 4 m/s for a third of a second from a frame on, and stands. */
    const dash = (from: number): number[] =>
      Array.from({ length: 150 }, (_, t) => (4 / FPS) * Math.min(10, Math.max(0, t - from)));
    const [soon, late] = [dash(32), dash(80)].map(dancer) as [SolvedMotion, SolvedMotion];
    const partner = dancer(dash(20));
    expect(limitRootSpeed(soon, partner, RULE)).toBe(soon);
    expect(Math.max(...speeds(limitRootSpeed(late, partner, RULE)))).toBeLessThan(1.501);
  });
});
