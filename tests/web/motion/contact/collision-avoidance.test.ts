import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import {
  type BodyRule,
  type CapsuleBody,
  capsuleBody,
  candidatePairs,
  penetrationDepth,
} from '../../../../web/motion/contact/capsules';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
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
    const reactor = stander((f) => [1.5 - 3 * eased(f, 60, 240), 0.03]);
    expect(top(overlaps(leader, reactor))).toBeGreaterThan(0.1);
    const apart = avoidCollisions(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const aside = shiftsOf(reactor, apart);
    const sides = aside.map(([, z]) => z).filter((z) => Math.abs(z) > 0.02);
    expect(new Set(sides.map(Math.sign)).size).toBe(1);
    const steps = aside.slice(1).map(([x, z], f) => Math.hypot(x - aside[f]![0], z - aside[f]![1]));
    expect(top(steps) * apart.fps).toBeLessThan(1);
  });

  test('shifts motions that differ little alike', () => {
    const shifts = Array.from({ length: 16 }, (_, i) => {
      const reactor = stander((f) => [0.1 + 0.4 * Math.sin(f / 40), i * 0.03 - 0.1]);
      return shiftsOf(reactor, avoidCollisions(reactor, leader, rule));
    });
    expect(top(shifts.flat().map(([x, z]) => Math.hypot(x, z)))).toBeGreaterThan(0.25);
    const changes = shifts.slice(1).map((shift, i) => {
      const before = shifts[i]!;
      return top(shift.map(([x, z], f) => Math.hypot(x - before[f]![0], z - before[f]![1])));
    });
    expect(top(changes)).toBeLessThan(0.15);
  });

  test('goes aside and back smoothly, and stays a while, for a moment of overlap', () => {
    const reactor = stander((f) => [0, f >= 149 && f < 152 ? 0.1 : 0.9]);
    const aside = shiftsOf(reactor, avoidCollisions(reactor, leader, rule)).map(([x, z]) => Math.hypot(x, z));
    expect(top(aside)).toBeGreaterThan(0.1);
    for (const f of [142, 150, 158]) expect(aside[f]).toBeGreaterThan(0.65 * top(aside));
    expect(top(aside.slice(0, 110).concat(aside.slice(190)))).toBeLessThan(1e-6);
    const turns = aside.slice(2).map((shift, f) => Math.abs(shift - 2 * aside[f + 1]! + aside[f]!));
    expect(top(turns) * 30 * 30).toBeLessThan(3);
  });

  test('shifts by at most 0.6 m', () => {
    const wide = { ...rule, capsules: rule.capsules.map((capsule) => ({ ...capsule, radius: 0.5 })) };
    const reactor = stander(() => [0, 0.1]);
    const aside = shiftsOf(reactor, avoidCollisions(reactor, leader, wide)).map(([x, z]) => Math.hypot(x, z));
    for (const shift of aside) expect(shift).toBeCloseTo(0.6, 5);
  });

  test('keeps its direction while the dancer sways', () => {
    const reactor = stander((f) => [0.12 * Math.sin((f * 2 * Math.PI) / 20), 0.1]);
    const angles = shiftsOf(reactor, avoidCollisions(reactor, leader, rule))
      .slice(60, 240)
      .map(([x, z]) => Math.abs(Math.atan2(x, z)));
    expect((top(angles) * 180) / Math.PI).toBeLessThan(4);
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

test('the depth at a shift is that of the shifted body, of all pairs within reach', () => {
  const axis = Array.from({ length: 13 }, (_, i) => (i - 6) / 10);
  const standing = (x: number, z: number): SolvedMotion => madeStander({ frames: 1, path: () => [x, z] });
  const [a, b] = [capsuleBody(standing(0, 0), rule), capsuleBody(standing(0.4, 0.3), rule)];
  const pairs = candidatePairs(a, b, 0, Math.hypot(0.6, 0.6));
  const depths = axis.flatMap((x) => axis.map((z) => penetrationDepth(a, b, pairs, { x, z })));
  const expected = axis.flatMap((x) =>
    axis.map((z) => {
      const moved = capsuleBody(standing(0.4 + x, 0.3 + z), rule);
      return penetrationDepth(a, moved, candidatePairs(a, moved, 0));
    }),
  );
  depths.forEach((depth, shift) => expect(depth).toBeCloseTo(expected[shift]!, 6));
  expect(expected.filter((depth) => depth > 0.02).length).toBeGreaterThan(30);
  expect(expected).toContain(0);
});
