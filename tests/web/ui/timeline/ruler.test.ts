import { describe, expect, it } from 'vitest';
import { rulerMarks } from '../../../../web/ui/timeline/ruler';
import type { CountedBeats } from '../../../../web/ui/store/counting';
import { timeScale } from '../../../../web/ui/store/time-scale';

const beats = (count: number, every: number, begin = 0, more: Partial<CountedBeats> = {}): CountedBeats => ({
  times: Array.from({ length: count }, (_, index) => begin + index * every),
  beatsPerBar: 4,
  first: 0,
  ...more,
});
const NONE = beats(0, 1);

describe('ruler', () => {
  it('numbers every bar from the first beat when there is room', () => {
    const { name, marks } = rulerMarks(beats(16, 0.5, 0.25), timeScale({ from: 0, to: 10 }, 600));
    expect(name).toBe('Bars');
    expect(marks.map(({ text }) => text)).toEqual(['1', '2', '3', '4']);
    expect(marks[1]?.at).toBeCloseTo(0.225);
  });

  it('numbers fewer bars when there is less room', () => {
    const { marks } = rulerMarks(beats(100, 0.34), timeScale({ from: 0, to: 35 }, 520));
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
    const { marks } = rulerMarks(beats(40, 0.5), timeScale({ from: 0, to: 4.6 }, 300));
    expect(marks.map(({ text }) => text)).toEqual(['1', '2', '3']);
  });

  it('shows the beats between the bars when zoomed in so far that there is room', () => {
    const { marks } = rulerMarks(beats(40, 0.5), timeScale({ from: 3.6, to: 6.2 }, 400));
    expect(marks.map(({ text }) => text)).toEqual(['3', '3.2', '3.3', '3.4', '4']);
    expect(marks[0]?.at).toBeCloseTo(0.4 / 2.6);
  });

  it('counts on in the second bar of eight, and to six in bars of three', () => {
    const near = timeScale({ from: 0, to: 4 }, 600);
    const texts = (all: CountedBeats): string[] => rulerMarks(all, near).marks.map(({ text }) => text);
    expect(texts(beats(9, 0.4))).toEqual(['1', '1.2', '1.3', '1.4', '2', '2.6', '2.7', '2.8', '3']);
    expect(texts(beats(8, 0.4, 0, { beatsPerBar: 3 }))).toEqual([
      '1',
      '1.2',
      '1.3',
      '2',
      '2.5',
      '2.6',
      '3',
      '3.2',
    ]);
    const upbeats = rulerMarks(beats(8, 0.4, 0, { first: 2 }), near).marks;
    expect(upbeats.map(({ text }) => text)).toEqual(['·7', '·8', '1', '1.2', '1.3', '1.4', '2', '2.6']);
    expect(upbeats.findIndex(({ one }) => one)).toBe(2);
  });

  it('leaves room where a short song fills only a part of the dance', () => {
    const { marks } = rulerMarks(beats(16, 0.5), timeScale({ from: 0, to: 30 }, 900));
    expect(marks.map(({ text }) => text)).toEqual(['1', '2', '3', '4']);
    const dense = rulerMarks(beats(16, 0.5), timeScale({ from: 0, to: 60 }, 900));
    expect(dense.marks.map(({ text }) => text)).toEqual(['1', '3']);
  });

  it('shows the seconds of a part', () => {
    const { marks } = rulerMarks(NONE, timeScale({ from: 8.7, to: 11.3 }, 230));
    expect(marks.map(({ text, at }) => [text, Number((at * 2.6).toFixed(3))])).toEqual([
      ['0:09', 0.3],
      ['0:10', 1.3],
      ['0:11', 2.3],
    ]);
  });

  it('leaves out a time that would be cut off at the end', () => {
    const { marks } = rulerMarks(NONE, timeScale({ from: 0, to: 30.2 }, 900));
    expect(marks.at(-1)?.text).toBe('0:28');
  });

  it('shows seconds where there are no beats', () => {
    const { name, marks } = rulerMarks(NONE, timeScale({ from: 0, to: 10 }, 400));
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
    expect(rulerMarks(NONE, timeScale({ from: 0, to: 100 }, 400)).marks.map(({ text }) => text)).toEqual([
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
    expect(rulerMarks(NONE, timeScale({ from: 0, to: 0 }, 1000)).marks).toEqual([]);
    expect(rulerMarks(NONE, timeScale({ from: 0, to: 10 }, 0)).marks).toEqual([]);
  });
});
