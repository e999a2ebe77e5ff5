import { expect, test } from 'vitest';
import { readCsv } from '../../../../../web/motion/import/tables/csv';

const titles = ['hip', 'knee', 'ankle'].flatMap((joint) => ['x', 'y', 'z'].map((axis) => `${joint}_${axis}`));
const rows = ['1,2,3,4,5,6,7,8,9', '1,2,3,4,5,6,7,8,9'];

test('a table with neither times nor a rate says that its rate is assumed', () => {
  expect(readCsv([titles.join(), ...rows].join('\n'), 0).rateAssumed).toBe(true);
  const timed = [`time,${titles.join()}`, ...rows.map((row, frame) => `${frame / 50},${row}`)];
  const source = readCsv(timed.join('\n'), 0);
  expect(source.rateAssumed).toBe(false);
  expect(source.frameRate()).toBe(50);
});

test('a table of thousands of columns is refused', () => {
  const wide = [...titles, ...Array.from({ length: 2992 }, (_, i) => `more${i}`)].join();
  expect(() => readCsv([wide, ...rows].join('\n'), 0)).toThrow('it has 3001 columns');
});
