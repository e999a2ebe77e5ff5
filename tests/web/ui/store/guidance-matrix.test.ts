import { describe, expect, it } from 'vitest';
import * as matrix from '../../../../web/ui/store/guidance-matrix';
import type { Guidance } from '../../../../web/ui/store/reaction';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { uniformGuidance } from '../../support/made-state';

const range = small.guidance.coarse;
const rows = (upper: number, lower: number, placement: number): Guidance => ({
  upper: { coarse: upper, fine: 0 },
  lower: { coarse: lower, fine: 0 },
  placement: { coarse: placement, fine: 0 },
});
const coarse = (guidance: Guidance): (number | undefined)[] =>
  Object.values(guidance).map((row) => row['coarse']);

describe('the fader of a layer', () => {
  it('moves the body parts together and keeps their differences', () => {
    expect(coarse(matrix.withColumn(rows(0.2, 0.5, -0.1), 'coarse', 0.4, range))).toEqual([0.4, 0.7, 0.1]);
    expect(matrix.columnOf(rows(0.2, 0.5, -0.1), 'coarse')).toEqual({ value: 0.2, mixed: true });
  });

  it('clamps each body part to the range, so that all are equal at its end', () => {
    const near = matrix.withColumn(rows(0, 0.5, 1), 'coarse', 0.8, range);
    expect(coarse(near)).toEqual([0.45, 0.95, 1]);
    for (const end of [range.min, range.max])
      expect(matrix.columnOf(matrix.withColumn(rows(0, 0.5, 1), 'coarse', end, range), 'coarse')).toEqual({
        value: end,
        mixed: false,
      });
  });

  it('ends at the end of a range that is no whole number of steps', () => {
    const uneven = { ...range, min: 0, max: 1, step: 0.4 };
    expect([0.5, 0.9, 1].map((value) => matrix.clampedToStep(value, uneven))).toEqual([0.4, 0.8, 1]);
  });

  it('does not change the other layer, and keeps equal parts equal', () => {
    const moved = matrix.withColumn(uniformGuidance(0.5, 0.2), 'fine', 0.73, small.guidance.fine);
    expect(moved).toEqual(uniformGuidance(0.5, 0.75));
  });

  it('can be stepped by keys however mixed the parts are', () => {
    let guidance = rows(0, 0.05, 0.7);
    const { value } = matrix.columnOf(guidance, 'coarse');
    for (let press = 0; press < 4; press++) {
      const shown = Math.round(matrix.columnOf(guidance, 'coarse').value / 0.05) * 0.05;
      guidance = matrix.withColumn(guidance, 'coarse', shown + 0.05, range);
    }
    expect(matrix.columnOf(guidance, 'coarse').value).toBeCloseTo(value + 0.2, 5);
  });
});

describe('changes of the guidance', () => {
  const ready = (): change.Store => {
    const store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    return store;
  };
  const guidance = (store: change.Store): Guidance => store.getState().settings?.guidance ?? {};

  it('set and reset one cell, clamped to range and step', () => {
    const store = ready();
    change.apply(store, change.guidanceCellSet('lower', 'fine', 7.33));
    expect(guidance(store)).toEqual({ ...uniformGuidance(0, 0), lower: { coarse: 0, fine: 1 } });
    change.apply(store, change.guidanceCellSet('lower', 'fine', 0.33));
    expect(guidance(store)['lower']?.['fine']).toBe(0.35);
    change.apply(store, change.guidanceCellReset('lower', 'fine'));
    expect(guidance(store)).toEqual(uniformGuidance(0, 0));
  });

  it('restore differences that the range clamped, while the same drag goes on', () => {
    const store = ready();
    change.apply(store, change.guidanceCellSet('upper', 'coarse', 0.6));
    const held = guidance(store);
    change.apply(store, change.guidanceSet('coarse', 1, held));
    expect(guidance(store)).toEqual(uniformGuidance(1, 0));
    change.apply(store, change.guidanceSet('coarse', matrix.columnOf(held, 'coarse').value, held));
    expect(guidance(store)).toEqual(held);
  });

  it('keep what another finger does to the other layer, while the same drag goes on', () => {
    const store = ready();
    const held = guidance(store);
    for (const value of [0.3, 0.5]) {
      change.apply(store, change.guidanceSet('coarse', value, held));
      change.apply(store, change.guidanceSet('fine', value, held));
    }
    change.apply(store, change.guidanceSet('coarse', 0.6, held));
    expect(guidance(store)).toEqual(uniformGuidance(0.6, 0.5));
  });

  it('reset one layer and leave the other', () => {
    const store = ready();
    change.apply(store, change.guidanceCellSet('upper', 'coarse', 0.6));
    change.apply(store, change.guidanceSet('fine', 1));
    change.apply(store, change.guidanceReset('coarse'));
    expect(guidance(store)).toEqual(uniformGuidance(0, 1));
  });

  it('come out as plain JSON', () => {
    const { settings } = ready().getState();
    expect(JSON.parse(JSON.stringify(settings))).toEqual(settings);
  });
});
