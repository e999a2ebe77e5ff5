import { describe, expect, it } from 'vitest';
import { measure } from '../../../../web/quality/measure';
import {
  verdictAboveChance,
  verdictNear,
  verdictAtMost,
  measureRows,
} from '../../../../web/ui/quality/quality-rows';
import { madeStander } from '../../support/made-stander';
import { small } from '../../support/small-manifest';

describe('the verdict on a number beside its reference', () => {
  it('is good up to a little above a reference that should not be exceeded', () => {
    expect([0.2, 0.36, 0.5, 0.7].map((value) => verdictAtMost(value, 0.33))).toEqual([
      'good',
      'good',
      'so-so',
      'poor',
    ]);
    expect(verdictAtMost(NaN, 0.33)).toBeNull();
    expect(verdictAtMost(0.2, null)).toBeNull();
  });

  it('is no better for a number far below a reference that it should equal', () => {
    expect([0.46, 0.34, 0.2].map((value) => verdictNear(value, 0.48))).toEqual(['good', 'so-so', 'poor']);
    expect(verdictNear(0.9, 0.48)).toBe('poor');
  });

  it('counts only what is above chance on the beat, and never calls chance good', () => {
    expect([0.31, 0.25, 0.16].map((value) => verdictAboveChance(value, 0.15, 0.32))).toEqual([
      'good',
      'so-so',
      'poor',
    ]);
    // Recorded dancers were no better than chance either.
    expect([0.25, 0.16, 0.1].map((value) => verdictAboveChance(value, 0.15, 0.15))).toEqual([
      'good',
      'so-so',
      'poor',
    ]);
    expect(verdictAboveChance(0.15, 0.15, null)).toBe('so-so');
    expect(verdictAboveChance(NaN, NaN, 0.3)).toBeNull();
  });
});

it('names each measure once, with its number, and with reference and verdict where there are any', () => {
  const { positions, fps, frames } = madeStander({ frames: 900, path: (t) => [0.3 * Math.sin(t / 20), 0] });
  const leader = positions.map((value, index) => (index % 3 === 2 ? value + 1 : value));
  const duet = { fps, frames, leader, reactor: positions, beats: [], block: 240 };
  const report = measure(duet, small.quality);
  const reference = {
    model: 'small',
    skateShare: 0.33,
    contactShare: 0.48,
    slideSpeed: null,
    overlapShare: 0.08,
    music: 0.15,
    leader: 0.32,
  };
  const rows = measureRows(report, reference);
  expect(rows.feet[0]).toMatchObject({ name: 'Feet slide', beside: 'recorded 33 %' });
  expect(rows.closeness[0]).toEqual({
    name: 'Bodies overlap',
    hint: 'never; hips never nearer than 1.00 m',
    value: '0 %',
    beside: 'recorded 8 %',
    verdict: 'good',
  });
  expect(rows.beats[0]).toMatchObject({ value: '–', beside: '', verdict: null });
  expect(rows.beats[1]?.beside).toMatch(/^recorded 0\.32, by chance \d\.\d\d$/);
  const alone = Object.values(measureRows(report, null)).flat();
  expect(alone.filter(({ beside }) => beside.startsWith('recorded'))).toEqual([]);
  expect(alone.find(({ name }) => name === 'Feet slide')).toMatchObject({ beside: '', verdict: null });
});
