import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import {
  type BodyRule,
  type CapsuleBody,
  capsuleBody,
  candidatePairs,
  penetrationDepth,
  shiftedDepths,
} from '../../../../web/motion/contact/capsules';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { SHIFTS, viterbiPath } from '../../../../web/motion/contact/viterbi-path';
import { avoidCollisions } from '../../../../web/motion/contact/collision-avoidance';
import { J, JOINT_COUNT } from '../../../../web/motion/skeleton/skeleton';
import { eased, madeStander } from '../../support/made-stander';

const golden = new URL('../../../fixtures/quality.json', import.meta.url);
const rule = (JSON.parse(readFileSync(golden, 'utf8')) as { rules: { penetration: BodyRule } }).rules
  .penetration;

const FRAMES = 300;
/** Arms stretched out to both sides reach 0.75 m. */
const stander = (path: (frame: number) => readonly [number, number]): SolvedMotion =>
  madeStander({ frames: FRAMES, path });
const leader = stander(() => [0, 0]);

const arm = /elbow|wrist/;
/** The rule without arms. */
const trunkRule: BodyRule = {
  ...rule,
  capsules: rule.capsules.filter(({ from, to }) => !arm.test(from) && !arm.test(to)),
};

/** Deepest overlap in every frame of all that is not an arm. */
function overlaps(a: SolvedMotion, b: SolvedMotion): number[] {
  const [first, second] = [capsuleBody(a, trunkRule), capsuleBody(b, trunkRule)];
  return Array.from({ length: FRAMES }, (_, f) =>
    penetrationDepth(first, second, candidatePairs(first, second, f)),
  );
}

/** The shift of a dancer, [x, z] in every frame, metres. */
function shiftsOf(before: SolvedMotion, after: SolvedMotion): [number, number][] {
  return Array.from({ length: FRAMES }, (_, f) => [
    after.root[3 * f]! - before.root[3 * f]!,
    after.root[3 * f + 2]! - before.root[3 * f + 2]!,
  ]);
}

const top = (values: readonly number[]): number => Math.max(...values);

describe('avoidCollisions', () => {
  test('returns the motion as it is without overlap, also where arms cross', () => {
    const reactor = stander(() => [0.9, 0.05]); // wrists and forearms overlap
    expect(top(overlaps(leader, reactor))).toBe(0);
    const whole = [capsuleBody(leader, rule), capsuleBody(reactor, rule)] as const;
    expect(penetrationDepth(...whole, candidatePairs(...whole, 0))).toBeGreaterThan(rule.deep);
    expect(avoidCollisions(reactor, leader, rule)).toBe(reactor);
  });

  test('shifts a dancer who would stand in the other, and returns to zero where they are apart', () => {
    const reactor = stander((f) => [0.05, 0.9 - 0.8 * (eased(f, 90, 130) - eased(f, 170, 210))]);
    expect(top(overlaps(leader, reactor))).toBeGreaterThan(0.1);
    const apart = avoidCollisions(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const aside = shiftsOf(reactor, apart).map(([x, z]) => Math.hypot(x, z));
    expect(top(aside)).toBeLessThan(0.4);
    expect(top(aside.slice(0, 30).concat(aside.slice(270)))).toBeLessThan(1e-6);
    // It goes aside as long before the encounter as it comes back after it.
    for (let f = 1; f < FRAMES; f++) expect(aside[f]).toBeCloseTo(aside[FRAMES - f]!, 5);
    // The whole body moves level, nothing turns, nothing is stretched.
    expect(apart.rotations).toEqual(reactor.rotations);
    for (let i = 0; i < FRAMES * JOINT_COUNT; i++) {
      const frame = Math.floor(i / JOINT_COUNT);
      const [x, z] = shiftsOf(reactor, apart)[frame]!;
      expect(apart.positions[3 * i]! - reactor.positions[3 * i]!).toBeCloseTo(x, 5);
      expect(apart.positions[3 * i + 1]).toBe(reactor.positions[3 * i + 1]);
      expect(apart.positions[3 * i + 2]! - reactor.positions[3 * i + 2]!).toBeCloseTo(z, 5);
    }
  });

  test('passes a dancer in the way on one side, slowly', () => {
    const reactor = stander((f) => [0.03, 1.5 - 3 * eased(f, 60, 240)]);
    expect(top(overlaps(leader, reactor))).toBeGreaterThan(0.1);
    const apart = avoidCollisions(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const aside = shiftsOf(reactor, apart);
    const sides = aside.map(([x]) => x).filter((x) => Math.abs(x) > 0.02);
    expect(new Set(sides.map(Math.sign)).size).toBe(1);
    const steps = aside.slice(1).map(([x, z], f) => Math.hypot(x - aside[f]![0], z - aside[f]![1]));
    expect(top(steps) * apart.fps).toBeLessThan(1);
  });

  test('shifts by a constant where dancers overlap from the first frame to the last', () => {
    const reactor = stander(() => [0, 0.1]);
    const apart = avoidCollisions(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const z = shiftsOf(reactor, apart).map(([x, z]) => Math.hypot(x, z));
    expect(top(z) - Math.min(...z)).toBeLessThan(0.01);
  });

  test('leaves a touch that is shallower than an overlap', () => {
    const touching = Array.from({ length: 100 }, (_, i) =>
      madeStander({ frames: 3, path: () => [0, 0.1 + i / 250] }),
    );
    const depthOf = (other: SolvedMotion): number => {
      const bodies = [leader, other].map((each) => capsuleBody(each, trunkRule)) as [
        CapsuleBody,
        CapsuleBody,
      ];
      return penetrationDepth(...bodies, candidatePairs(...bodies, 0));
    };
    const reactor = touching.find((other) => depthOf(other) < 0.8 * rule.deep)!;
    expect(depthOf(reactor)).toBeGreaterThan(0.2 * rule.deep);
    expect(avoidCollisions(reactor, madeStander({ frames: 3 }), rule)).toBe(reactor);
  });

  test('does not shift a dancer who stands close without overlap', () => {
    // Standing half a metre off, level with the other: heads and trunks do not touch.
    const reactor = stander(() => [0, 0.5]);
    expect(avoidCollisions(reactor, leader, rule).positions[J.head * 3]).toBe(reactor.positions[J.head * 3]);
  });
});

test('the depth at a shift is that of the shifted body', () => {
  const axis = Array.from({ length: 25 }, (_, i) => (i - 12) / 20);
  const columns = axis.map((x, i) => ({ first: i * axis.length, x, z: Float64Array.from(axis) }));
  // Every second of three frames is sampled.
  const standing = (x: number, z: number): SolvedMotion =>
    madeStander({ frames: 3, path: (frame) => [x + frame / 40, z] });
  const [a, b] = [standing(0, 0), standing(0.05, 0.06)];
  const bodies = [capsuleBody(a, rule, 2), capsuleBody(b, rule, 2)] as const;
  for (const sample of [0, 1]) {
    const depths = shiftedDepths(...bodies, sample, columns);
    const expected = axis.flatMap((x) =>
      axis.map((z) => {
        const [still, moved] = [capsuleBody(a, rule), capsuleBody(standing(0.05 + x, 0.06 + z), rule)];
        return penetrationDepth(still, moved, candidatePairs(still, moved, 2 * sample));
      }),
    );
    expect(depths).toHaveLength(expected.length);
    depths.forEach((depth, shift) => expect(depth).toBeCloseTo(expected[shift]!, 6));
    expect(expected.filter((depth) => depth > 0.02).length).toBeGreaterThan(50);
    expect(expected).toContain(0);
  }
});

describe('viterbiPath', () => {
  const free = (): Float64Array => Float64Array.from(SHIFTS, ({ x, z }) => x * x + z * z);
  const indexOf = (x: number, z: number): number =>
    SHIFTS.findIndex((p) => Math.abs(p.x - x) < 1e-9 && Math.abs(p.z - z) < 1e-9);

  test('has no shift where nothing overlaps', () => {
    expect(viterbiPath([free(), free(), free()], { start: false, end: false })).toEqual(
      Array(3).fill({ x: 0, z: 0 }),
    );
  });

  test('is the cheapest of all paths of three samples, by exhaustive search', () => {
    const bumpy = (seed: number): Float64Array =>
      Float64Array.from(SHIFTS, (_, i) => 1 + Math.sin(seed + 12.9898 * i) * Math.cos(seed * i));
    const costs = [bumpy(1), bumpy(2), bumpy(3)];
    const cost = (path: readonly { x: number; z: number }[]): number =>
      path.reduce((sum, { x, z }, i) => {
        const last = path[i - 1];
        const step = last ? 50 * ((x - last.x) ** 2 + (z - last.z) ** 2) : 0;
        return sum + costs[i]![indexOf(x, z)]! + step;
      }, 0);
    let least = Infinity;
    const near = (p: (typeof SHIFTS)[number]) =>
      SHIFTS.filter(({ x, z }) => Math.hypot(x - p.x, z - p.z) < 0.2);
    for (const b of SHIFTS) {
      for (const a of near(b)) for (const c of near(b)) least = Math.min(least, cost([a, b, c]));
    }
    expect(cost(viterbiPath(costs, { start: false, end: false }))).toBeCloseTo(least, 9);
  });

  test('shifts by at most 0.56 m, in steps of at most 0.2 m, whatever staying costs', () => {
    expect(top(SHIFTS.map(({ x, z }) => Math.hypot(x, z)))).toBeCloseTo(0.56, 9);
    const drawnTo = (to: number): Float64Array =>
      Float64Array.from(SHIFTS, ({ x, z }) => 1e6 * ((x - to) ** 2 + z ** 2));
    const path = viterbiPath([drawnTo(0), drawnTo(0.56), drawnTo(0.56)], { start: false, end: false });
    const steps = path.slice(1).map(({ x, z }, i) => Math.hypot(x - path[i]!.x, z - path[i]!.z));
    expect(top(steps)).toBeCloseTo(0.14, 9);
  });

  test('begins and ends with a shift of zero where it has to, whatever that costs', () => {
    const wall = free();
    wall[indexOf(0, 0)] = 1000;
    const path = viterbiPath([wall, wall, wall], { start: true, end: true });
    expect([path[0], path[2]]).toEqual([
      { x: 0, z: 0 },
      { x: 0, z: 0 },
    ]);
    expect(path[1]).not.toEqual({ x: 0, z: 0 });
  });
});
