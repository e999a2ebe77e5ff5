import { expect, test } from 'vitest';
import { stepCounts } from '../../../../web/motion/beats/step-timing';

const every = (gap: number, count: number, from = 0): number[] =>
  Array.from({ length: count }, (_, i) => Math.round(from + i * gap));
/** Frames at which a step ends. */
const ends = (counts: Float64Array): number[] =>
  [...counts.keys()].filter(
    (frame) => frame > 0 && Math.floor(counts[frame]!) > Math.floor(counts[frame - 1]!),
  );

test('without beats a step takes a third of a second', () => {
  expect(ends(stepCounts([], 45, 30))).toEqual([10, 20, 30, 40]);
  expect(ends(stepCounts([], 90, 60))).toEqual([20, 40, 60, 80]);
  // A single beat has no tempo, but a place.
  expect(ends(stepCounts([7], 45, 30))).toEqual([7, 17, 27, 37]);
});

test('every beat ends a step, and steps take from a quarter to half a second', () => {
  for (const bpm of [40, 60, 75, 90, 104, 120, 127, 131, 150, 180, 200, 240]) {
    const gap = 1800 / bpm;
    const beats = every(gap, 40, 4);
    const steps = ends(stepCounts(beats, beats.at(-1)! + 1, 30));
    const length = (steps.at(-1)! - steps[0]!) / (steps.length - 1);
    expect(length, `${bpm} bpm`).toBeGreaterThan(6.9);
    expect(length, `${bpm} bpm`).toBeLessThan(14.6);
    for (const beat of beats.slice(1)) expect(steps, `${bpm} bpm`).toContain(beat);
  }
});

test('beats need not be on frames', () => {
  expect(ends(stepCounts([0.4, 10.6, 20.2, 30.8], 45, 30))).toEqual([1, 11, 21, 31, 41]);
});

test('two beats of a song so quick that one is no step have one', () => {
  expect(ends(stepCounts(every(6, 11), 61, 30))).toEqual([12, 24, 36, 48, 60]);
});

test('beats at half or twice the tempo give the same steps', () => {
  const [half, plain, double] = [40, 20, 10].map((gap) => ends(stepCounts(every(gap, 400 / gap), 361, 30)));
  expect(half).toEqual(plain);
  expect(double).toEqual(plain);
  expect(plain).toContain(90);
});

test('steps follow a tempo that changes', () => {
  const beats = [0, 10, 20, 29, 38, 50, 62];
  expect(ends(stepCounts(beats, 63, 30))).toEqual([10, 20, 29, 38, 50, 62]);
});

test('beats that are missing are filled in, before the first and after the last too', () => {
  const beats = [25, 35, 45, 75, 85];
  const counts = stepCounts(beats, 121, 30);
  expect(ends(counts)).toEqual([5, 15, 25, 35, 45, 55, 65, 75, 85, 95, 105, 115]);
  expect(counts[25]).toBe(0);
  expect(counts[20]).toBeCloseTo(-0.5, 10);
});
