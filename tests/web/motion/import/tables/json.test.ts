import { expect, test } from 'vitest';
import { readJsonMotion } from '../../../../../web/motion/import/tables/json';

const frames = (x: number, joints: number): number[][][] =>
  [0, 1].map(() => Array.from({ length: joints }, () => [x, 0, 0]));
const read = (json: object, part = 0) => readJsonMotion(JSON.stringify(json), part);

test('rate and unit are those of the form that this page writes', () => {
  const stated = read({ fps: 50, positions: frames(0, 22) });
  expect(stated).toMatchObject({ rateAssumed: false, unit: { name: 'metres', metres: 1 }, upAxis: 'y' });
  expect(stated.frameRate()).toBe(50);
  const silent = read({ positions: frames(0, 22) });
  expect(silent.rateAssumed).toBe(true);
  expect(silent.frameRate()).toBe(30);
});

test('the chosen dancer is read', () => {
  const positions = { leader: frames(3, 22), reactor: frames(7, 22) };
  expect(read({ positions }, 1)).toMatchObject({ part: 1 });
  expect(read({ positions }, 1).localPoses([0]).translations[0]).toBe(7);
  expect(read({ positions }, 2)).toMatchObject({ part: 0 });
});

test('a joint hangs on one before it, or on none', () => {
  const json = { joints: ['a', 'b', 'c', 'd'], parents: [1, 0, 2, 1.5], positions: frames(0, 4) };
  expect(read(json).joints.map(({ parent }) => parent)).toEqual([-1, 0, -1, -1]);
});

test('a point has three numbers', () => {
  const four = [0, 1].map(() => Array.from({ length: 22 }, () => [0, 0, 0, 0.9]));
  expect(() => read({ positions: four })).toThrow('point 1 of frame 1 is not [x, y, z]');
});
