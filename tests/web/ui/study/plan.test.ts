import { describe, expect, test } from 'vitest';
import { type Comparable, makePlan } from '../../../../web/ui/study/plan';

const duets: Comparable[] = ['a', 'b', 'c', 'd', 'e'].map((name) => ({
  name,
  methods: ['ours', 'edge', 'truth', 'mirror'],
}));
const count = <T>(list: readonly T[], is: (one: T) => boolean): number => list.filter(is).length;
const key = ({ duet, left, right }: { duet: string; left: string; right: string }): string =>
  [duet, ...[left, right].sort()].join(' ');

describe('the plan of a blind test', () => {
  test('compares the reference with every other method of every duet, once', () => {
    const plan = makePlan(duets, 'ours', 100, 1);
    expect(plan).toHaveLength(15);
    expect(new Set(plan.map(key)).size).toBe(15);
    for (const { left, right } of plan) expect([left, right]).toContain('ours');
  });

  test('of many pairs each opponent gets as many as the others', () => {
    for (let seed = 0; seed < 50; seed++) {
      const plan = makePlan(duets, 'ours', 9, seed);
      for (const method of ['edge', 'truth', 'mirror'])
        expect(count(plan, ({ left, right }) => left === method || right === method)).toBe(3);
    }
  });

  test('a method is on either side equally often, and nobody can tell in advance on which', () => {
    let leftAtFirst = 0;
    for (let seed = 0; seed < 400; seed++) {
      const plan = makePlan(duets, 'ours', 100, seed);
      for (const method of ['edge', 'truth', 'mirror']) {
        const left = count(plan, (pair) => pair.left === method);
        expect(Math.abs(left - 2.5)).toBe(0.5);
      }
      leftAtFirst += Number(plan[0]!.left === 'ours');
    }
    expect(leftAtFirst).toBeGreaterThan(150);
    expect(leftAtFirst).toBeLessThan(250);
  });

  test('so it is without a reference, in whichever order the methods of a duet come', () => {
    const two = [
      { name: 'a', methods: ['edge', 'truth'] },
      { name: 'b', methods: ['truth', 'edge'] },
    ];
    for (let seed = 0; seed < 20; seed++)
      expect(count(makePlan(two, null, 100, seed), ({ left }) => left === 'edge')).toBe(1);
  });

  test('every pair comes first about equally often', () => {
    const first = new Map<string, number>();
    for (let seed = 0; seed < 1500; seed++) {
      const [pair] = makePlan(duets, 'ours', 100, seed);
      first.set(key(pair!), (first.get(key(pair!)) ?? 0) + 1);
    }
    expect(first.size).toBe(15);
    for (const times of first.values()) expect(Math.abs(times - 100)).toBeLessThan(45);
  });

  test('opponents do not come in turn', () => {
    const other = ({ left, right }: { left: string; right: string }): string =>
      left === 'ours' ? right : left;
    let twice = 0;
    for (let seed = 0; seed < 100; seed++) {
      const [first, second] = makePlan(duets, 'ours', 15, seed);
      twice += Number(other(first!) === other(second!));
    }
    expect(twice).toBeGreaterThan(10);
  });

  test('the same seed gives the same plan, another one another', () => {
    expect(makePlan(duets, 'ours', 15, 7)).toEqual(makePlan(duets, 'ours', 15, 7));
    expect(makePlan(duets, 'ours', 15, 7)).not.toEqual(makePlan(duets, 'ours', 15, 8));
  });

  test('without a reference all methods are compared with each other', () => {
    const plan = makePlan(duets.slice(0, 2), null, 100, 3);
    expect(plan).toHaveLength(12);
    expect(new Set(plan.map(key)).size).toBe(12);
  });

  test('a duet without the reference is left out', () => {
    const mixed = [...duets.slice(0, 1), { name: 'z', methods: ['edge', 'truth'] }];
    expect(makePlan(mixed, 'ours', 100, 1).every(({ duet }) => duet === 'a')).toBe(true);
  });
});
