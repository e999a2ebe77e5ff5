import { describe, expect, it } from 'vitest';
import { presetOf, presets } from '../../../../web/ui/guidance/presets';
import { small } from '../../support/small-manifest';
import { uniformGuidance } from '../../support/made-state';

describe('presets', () => {
  const list = presets(small);
  const named = (name: string) => list.find((preset) => preset.name === name);

  it('begin with the defaults and differ from each other', () => {
    const { music, variety } = small.guidance;
    expect(list[0]).toMatchObject({
      name: 'Balanced',
      guidance: uniformGuidance(0, 0),
      music: music.default,
      variety: variety.default,
    });
    const values = list.map(({ guidance, music, variety }) => JSON.stringify([guidance, music, variety]));
    expect(new Set(values).size).toBe(list.length);
    for (const { name, description } of list) {
      expect(name.length).toBeLessThanOrEqual(10);
      expect(description).toMatch(/^[A-Z][^.]+\.$/);
    }
  });

  it('go from the defaults towards the ends of the ranges, on their steps', () => {
    expect(named('Loose')?.guidance).toEqual(uniformGuidance(-0.7, 0));
    expect(named('Sharp')?.guidance).toEqual(uniformGuidance(0, 0.8));
    expect(named('Less song')?.music).toBe(small.guidance.music.min);
    expect(named('More song')?.music).toBe(small.guidance.music.max);
    expect(named('Average')?.variety).toBe(small.guidance.variety.min);
    expect(named('Individual')?.variety).toBe(1.7);
  });

  it('count as chosen exactly while the values match', () => {
    const balanced = list[0]!;
    expect(presetOf(list, balanced)).toBe(balanced);
    for (const preset of list) expect(presetOf(list, preset)).toBe(preset);
    expect(presetOf(list, { ...balanced, music: 0.25 })).toBeNull();
    expect(presetOf(list, { ...balanced, variety: 0.95 })).toBeNull();
    const mixed = { ...balanced.guidance, upper: { coarse: 0, fine: 0.05 } };
    expect(presetOf(list, { ...balanced, guidance: mixed })).toBeNull();
  });
});
