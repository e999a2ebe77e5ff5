import { describe, expect, it } from 'vitest';
import * as matrix from '../../../../web/ui/store/guidance-matrix';
import { presetOf, presets } from '../../../../web/ui/guidance/presets';
import type { Guidance } from '../../../../web/ui/store/reaction';
import * as change from '../../support/actions';
import { small } from '../../support/small-manifest';
import { uniformGuidance } from '../../support/made-state';

const range = small.guidance;
const rows = (upper: number, lower: number, placement: number): Guidance => ({
  upper: { coarse: upper, fine: 0 },
  lower: { coarse: lower, fine: 0 },
  placement: { coarse: placement, fine: 0 },
});
const coarse = (guidance: Guidance): (number | undefined)[] =>
  Object.values(guidance).map((row) => row['coarse']);

describe('the fader of a layer', () => {
  it('moves the body parts together and keeps their differences', () => {
    expect(coarse(matrix.withColumn(rows(1, 1.5, 0.5), 'coarse', 2, range))).toEqual([2, 2.5, 1.5]);
    expect(matrix.columnOf(rows(1, 1.5, 0.5), 'coarse')).toEqual({ value: 1, mixed: true });
  });

  it('clamps each body part to the range, so that all are equal at its end', () => {
    const near = matrix.withColumn(rows(1, 2, 3), 'coarse', 2.5, range);
    expect(coarse(near)).toEqual([1.75, 2.75, 3]);
    for (const end of [range.min, range.max])
      expect(matrix.columnOf(matrix.withColumn(rows(1, 2, 3), 'coarse', end, range), 'coarse')).toEqual({
        value: end,
        mixed: false,
      });
  });

  it('does not change the other layer, and keeps equal parts equal', () => {
    const moved = matrix.withColumn(uniformGuidance(0.5, 0.2), 'fine', 1.23, range);
    expect(moved).toEqual(uniformGuidance(0.5, 1.25));
  });

  it('can be stepped by keys however mixed the parts are', () => {
    let guidance = rows(1, 1.05, 2);
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
    expect(guidance(store)).toEqual({ ...uniformGuidance(0, 0), lower: { coarse: 0, fine: 3 } });
    change.apply(store, change.guidanceCellSet('lower', 'fine', 0.33));
    expect(guidance(store)['lower']?.['fine']).toBe(0.35);
    change.apply(store, change.guidanceCellReset('lower', 'fine'));
    expect(guidance(store)).toEqual(uniformGuidance(0, 0));
  });

  it('restore differences that the range clamped, while the same drag goes on', () => {
    const store = ready();
    change.apply(store, change.guidanceCellSet('upper', 'coarse', 2));
    const held = guidance(store);
    change.apply(store, change.guidanceSet('coarse', 3, held));
    expect(guidance(store)).toEqual(uniformGuidance(3, 0));
    change.apply(store, change.guidanceSet('coarse', matrix.columnOf(held, 'coarse').value, held));
    expect(guidance(store)).toEqual(held);
  });

  it('reset one layer and leave the other', () => {
    const store = ready();
    change.apply(store, change.guidanceCellSet('upper', 'coarse', 2));
    change.apply(store, change.guidanceSet('fine', 1));
    change.apply(store, change.guidanceReset('coarse'));
    expect(guidance(store)).toEqual(uniformGuidance(0, 1));
  });

  it('come out as plain JSON', () => {
    const { settings } = ready().getState();
    expect(JSON.parse(JSON.stringify(settings))).toEqual(settings);
  });
});

describe('presets', () => {
  const list = presets(small);

  it('are the model’s default and the six rows of Table 4', () => {
    expect(list.map(({ guidance }) => Object.values(guidance['placement'] ?? {}))).toEqual([
      [0, 0],
      [1, 1],
      [1, 1.2],
      [1, 1.5],
      [1.2, 1.2],
      [1.2, 1.5],
      [1.5, 1.5],
    ]);
    expect(presetOf(list, { guidance: uniformGuidance(1.2, 1.2), music: 0 })?.name).toBe("Paper's choice");
  });

  it('count as chosen exactly while the values match', () => {
    const { music } = small.guidance;
    expect(presetOf(list, { guidance: uniformGuidance(0, 0), music: music.default })?.name).toBe('Balanced');
    expect(presetOf(list, { guidance: uniformGuidance(0, 0), music: 0 })).toBeNull();
    const mixed = { ...uniformGuidance(1.2, 1.2), upper: { coarse: 1.2, fine: 1.25 } };
    expect(presetOf(list, { guidance: mixed, music: 0 })).toBeNull();
  });
});
