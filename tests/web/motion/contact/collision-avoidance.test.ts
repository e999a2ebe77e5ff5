import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import {
  type BodyRule,
  type CapsuleBody,
  capsuleBody,
  closePairs,
  deepest,
} from '../../../../web/motion/contact/capsules';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { cheapestDetour, PLACES } from '../../../../web/motion/contact/viterbi-path';
import { keepApart } from '../../../../web/motion/contact/collision-avoidance';
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

/** Deepest overlap in every frame of all that is not an arm. */
function overlaps(a: SolvedMotion, b: SolvedMotion): number[] {
  const arm = /elbow|wrist/;
  const solid = {
    ...rule,
    capsules: rule.capsules.filter(({ from, to }) => !arm.test(from) && !arm.test(to)),
  };
  const [first, second] = [capsuleBody(a, solid), capsuleBody(b, solid)];
  return Array.from({ length: FRAMES }, (_, f) => deepest(first, second, closePairs(first, second, f)));
}

/** How far aside the second stands, [x, z] in every frame. */
function asides(before: SolvedMotion, after: SolvedMotion): [number, number][] {
  return Array.from({ length: FRAMES }, (_, f) => [
    after.root[3 * f]! - before.root[3 * f]!,
    after.root[3 * f + 2]! - before.root[3 * f + 2]!,
  ]);
}

const top = (values: readonly number[]): number => Math.max(...values);

describe('keepApart', () => {
  test('leaves those alone who never meet, also when arms cross', () => {
    const reactor = stander(() => [0.9, 0.05]); // wrists and forearms in each other
    expect(top(overlaps(leader, reactor))).toBe(0);
    const whole = [capsuleBody(leader, rule), capsuleBody(reactor, rule)] as const;
    expect(deepest(...whole, closePairs(...whole, 0))).toBeGreaterThan(rule.deep);
    expect(keepApart(reactor, leader, rule)).toBe(reactor);
  });

  test('stands beside the one it would stand in, and is back where they are apart', () => {
    const reactor = stander((f) => [0.05, 0.9 - 0.8 * (eased(f, 90, 130) - eased(f, 170, 210))]);
    expect(top(overlaps(leader, reactor))).toBeGreaterThan(0.1);
    const apart = keepApart(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const aside = asides(reactor, apart).map(([x, z]) => Math.hypot(x, z));
    expect(top(aside)).toBeLessThan(0.4);
    expect(top(aside.slice(0, 30).concat(aside.slice(270)))).toBeLessThan(1e-6);
    // The whole body moves level, nothing turns, nothing is stretched.
    expect(apart.rotations).toEqual(reactor.rotations);
    for (let i = 0; i < FRAMES * JOINT_COUNT; i++) {
      const frame = Math.floor(i / JOINT_COUNT);
      const [x, z] = asides(reactor, apart)[frame]!;
      expect(apart.positions[3 * i]! - reactor.positions[3 * i]!).toBeCloseTo(x, 5);
      expect(apart.positions[3 * i + 1]).toBe(reactor.positions[3 * i + 1]);
      expect(apart.positions[3 * i + 2]! - reactor.positions[3 * i + 2]!).toBeCloseTo(z, 5);
    }
  });

  test('goes round the one it would walk through, on one side and without haste', () => {
    const reactor = stander((f) => [0.03, 1.5 - 3 * eased(f, 60, 240)]);
    expect(top(overlaps(leader, reactor))).toBeGreaterThan(0.1);
    const apart = keepApart(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const aside = asides(reactor, apart);
    const sides = aside.map(([x]) => x).filter((x) => Math.abs(x) > 0.02);
    expect(new Set(sides.map(Math.sign)).size).toBe(1);
    const steps = aside.slice(1).map(([x, z], f) => Math.hypot(x - aside[f]![0], z - aside[f]![1]));
    expect(top(steps) * apart.fps).toBeLessThan(0.9);
  });

  test('keeps those apart who are too close from the first frame to the last', () => {
    const reactor = stander(() => [0, 0.1]);
    const apart = keepApart(reactor, leader, rule);
    expect(top(overlaps(leader, apart))).toBeLessThan(0.02);
    const z = asides(reactor, apart).map(([x, z]) => Math.hypot(x, z));
    expect(top(z) - Math.min(...z)).toBeLessThan(0.01); // a place found at once and kept
  });

  test('moves nobody who only bows over', () => {
    // Standing half a metre off, level with the other: heads and trunks do not touch.
    const reactor = stander(() => [0, 0.5]);
    expect(keepApart(reactor, leader, rule).positions[J.head * 3]).toBe(reactor.positions[J.head * 3]);
  });
});

test('a shift in thought is a shift in fact', () => {
  const reactor = stander(() => [0.05, 0.06]);
  for (const [x, z] of [
    [0, 0],
    [0.12, 0],
    [0, 0.09],
    [-0.1, 0.05],
  ] as const) {
    const [a, b, moved] = [leader, reactor, stander(() => [0.05 + x, 0.06 + z])].map((m) =>
      capsuleBody(m, rule),
    ) as [CapsuleBody, CapsuleBody, CapsuleBody];
    const there = deepest(a, moved, closePairs(a, moved, 0));
    expect(there).toBeGreaterThan(0.02);
    expect(deepest(a, b, closePairs(a, b, 0, 0.2), x, z)).toBeCloseTo(there, 6);
  }
});

describe('cheapestDetour', () => {
  const free = (): Float64Array => Float64Array.from(PLACES, ({ x, z }) => x * x + z * z);
  const place = (x: number, z: number): number =>
    PLACES.findIndex((p) => Math.abs(p.x - x) < 1e-9 && Math.abs(p.z - z) < 1e-9);

  test('stays where nothing is in the way', () => {
    expect(cheapestDetour([free(), free(), free()], { start: false, end: false })).toEqual(
      Array(3).fill({ x: 0, z: 0 }),
    );
  });

  test('is the cheapest of all ways of three samples', () => {
    const bumpy = (seed: number): Float64Array =>
      Float64Array.from(PLACES, (_, i) => 1 + Math.sin(seed + 12.9898 * i) * Math.cos(seed * i));
    const costs = [bumpy(1), bumpy(2), bumpy(3)];
    const cost = (way: readonly { x: number; z: number }[]): number =>
      way.reduce((sum, { x, z }, i) => {
        const last = way[i - 1];
        const step = last ? 50 * ((x - last.x) ** 2 + (z - last.z) ** 2) : 0;
        return sum + costs[i]![place(x, z)]! + step;
      }, 0);
    let least = Infinity;
    const near = (p: (typeof PLACES)[number]) =>
      PLACES.filter(({ x, z }) => Math.hypot(x - p.x, z - p.z) < 0.211);
    for (const b of PLACES) {
      for (const a of near(b)) for (const c of near(b)) least = Math.min(least, cost([a, b, c]));
    }
    expect(cost(cheapestDetour(costs, { start: false, end: false }))).toBeCloseTo(least, 9);
  });

  test('begins and ends in the middle where it has to, whatever that costs', () => {
    const wall = free();
    wall[place(0, 0)] = 1000;
    const way = cheapestDetour([wall, wall, wall], { start: true, end: true });
    expect([way[0], way[2]]).toEqual([
      { x: 0, z: 0 },
      { x: 0, z: 0 },
    ]);
    expect(way[1]).not.toEqual({ x: 0, z: 0 });
  });
});
