import { expect, test } from 'vitest';
import { readCsv } from '../../../../../web/motion/import/tables/csv';
import { readJsonMotion } from '../../../../../web/motion/import/tables/json';

/** Three joints a dancer, whose x is that of the dancer. */
const table = (titles: readonly (readonly [string, number])[]): string =>
  [
    titles.flatMap(([dancer]) =>
      ['hip', 'knee', 'ankle'].flatMap((joint) =>
        ['x', 'y', 'z'].map((axis) => `${dancer}_${joint}_${axis}`),
      ),
    ),
    ...[1, 2].map(() => titles.flatMap(([, x]) => [x, 2, 0, x, 1, 0, x, 0, 0])),
  ]
    .map((cells) => cells.join(','))
    .join('\n');

test.each([
  ['reactor', 'leader'],
  ['Reactor', 'Leader'],
  ['FOLLOWER', 'LEADER'],
])('the leader of a table comes first, also after the %s', (other, leader) => {
  const text = table([
    [other, 7],
    [leader, 3],
  ]);
  for (const [part, x] of [3, 7].entries()) {
    const source = readCsv(text, part);
    expect(source.parts).toEqual([leader, other]);
    expect(source.localPoses([0]).translations[0]).toBe(x);
  }
});

test('a dancer of a table is one, however the columns are capitalised', () => {
  const text = table([['leader', 3]])
    .replace('leader_knee', 'Leader_knee')
    .replace('leader_ankle', 'LEADER_ankle');
  const source = readCsv(text, 0);
  expect(source.parts).toEqual([]);
  expect(source.joints.map(({ name }) => name)).toEqual(['hip', 'knee', 'ankle']);
});

test('the leader of a JSON comes first, however it is written', () => {
  const points = (x: number): number[][] => Array.from({ length: 22 }, () => [x, 0, 0]);
  const positions = { Reactor: [points(7), points(7)], Leader: [points(3), points(3)] };
  const source = readJsonMotion(JSON.stringify({ positions }), 0);
  expect(source.parts).toEqual(['Leader', 'Reactor']);
  expect(source.localPoses([0]).translations[0]).toBe(3);
});
