import { expect, it } from 'vitest';
import { beatPeriod } from '../../../../web/audio/dsp/tempo';
import { recipe } from '../../support/audio/audio-fixtures';

it.each([
  ['in silence', 0, 0],
  ['into a sound', 3, 0],
  ['out of a sound', 0, 3],
])('five seconds of clicks that are cut %s have their own period, whichever it is', (_, first, last) => {
  const periods = Array.from({ length: 13 }, (_, i) => 11 + i);
  const found = periods.map((period) => {
    const onset = Float64Array.from({ length: 150 }, (_, frame) => (frame % period === 5 ? 1 : 0));
    onset[0]! += first;
    onset[onset.length - 1]! += last;
    return beatPeriod(onset, recipe);
  });
  expect(found).toEqual(periods);
});
