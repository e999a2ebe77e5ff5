import { expect, it } from 'vitest';
import { tempoCurve } from '../../../../web/audio/rhythm/tempo-curve';

const FPS = 30;

/** Onsets of a beat, and in the middle of the song a quicker rhythm over it. Mean zero. */
function onsets(
  bpm: number,
  quicker: number,
  [from, to]: readonly [number, number],
  level: number,
): Float64Array {
  const values = new Float64Array(50 * FPS);
  const add = (second: number, height: number): void => {
    const at = Math.round(second * FPS);
    if (at < values.length) values[at]! += height;
  };
  for (let second = 0.5; second < 50; second += 60 / bpm) add(second, 1);
  for (let second = from; second < to; second += 60 / (bpm * quicker)) add(second, level);
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  return values.map((value) => value - mean);
}

it('stays with the beat where some bars have a rhythm of three against two', () => {
  const { periods } = tempoCurve(onsets(95, 3 / 2, [20, 30], 3), FPS);
  const tempi = Array.from(periods, (period) => (60 * FPS) / period);
  expect(Math.min(...tempi)).toBeGreaterThan(94);
  expect(Math.max(...tempi)).toBeLessThan(96.5);
});
