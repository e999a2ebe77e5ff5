import { describe, expect, it } from 'vitest';
import { rulerMarks } from '../../../web/ui/ruler';

const beats = (count: number, every: number, first = 0): number[] =>
  Array.from({ length: count }, (_, index) => first + index * every);

describe('ruler', () => {
  it('numbers every bar from the first beat when there is room', () => {
    const { name, marks } = rulerMarks(beats(16, 0.5, 0.25), 10, 1000);
    expect(name).toBe('Bars');
    expect(marks.map(({ text }) => text)).toEqual(['1', '2', '3', '4']);
    expect(marks[1]?.at).toBeCloseTo(0.225);
  });

  it('numbers fewer bars when there is less room', () => {
    const { marks } = rulerMarks(beats(100, 0.34), 35, 520);
    expect(marks.map(({ text }) => text)).toEqual([
      '1',
      '3',
      '5',
      '7',
      '9',
      '11',
      '13',
      '15',
      '17',
      '19',
      '21',
      '23',
      '25',
    ]);
  });

  it('leaves out bars after the end of the dance', () => {
    const { marks } = rulerMarks(beats(40, 0.5), 4.1, 1000);
    expect(marks.map(({ text }) => text)).toEqual(['1', '2', '3']);
  });

  it('tells the time where no beat is', () => {
    const { name, marks } = rulerMarks([], 10, 400);
    expect(name).toBe('Time');
    expect(marks.map(({ text }) => text)).toEqual([
      '0:00',
      '0:01',
      '0:02',
      '0:03',
      '0:04',
      '0:05',
      '0:06',
      '0:07',
      '0:08',
      '0:09',
    ]);
    expect(rulerMarks([], 100, 400).marks.map(({ text }) => text)).toEqual([
      '0:00',
      '0:10',
      '0:20',
      '0:30',
      '0:40',
      '0:50',
      '1:00',
      '1:10',
      '1:20',
      '1:30',
    ]);
  });

  it('is empty before anything is loaded', () => {
    expect(rulerMarks([], 0, 1000).marks).toEqual([]);
    expect(rulerMarks([], 10, 0).marks).toEqual([]);
  });
});
