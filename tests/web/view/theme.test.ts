import { readFileSync } from 'node:fs';
import path from 'node:path';
import { describe, expect, it } from 'vitest';
import type { Theme } from '../../../web/common/picture';
import { LOOKS } from '../../../web/view/theme';

/** Relative luminance of a colour, as WCAG 2 defines it. */
function luminance(colour: number): number {
  const [red, green, blue] = [16, 8, 0].map((shift) => {
    const part = ((colour >> shift) & 255) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

describe.each<Theme>(['dark', 'light'])('the dancers, %s', (theme) => {
  const { leader, reactor } = LOOKS[theme];

  it('differ in lightness, for whoever sees no hues', () => {
    expect((luminance(reactor) + 0.05) / (luminance(leader) + 0.05)).toBeGreaterThan(1.8);
  });

  it('have in the legend the colours that they have on the stage', () => {
    const tokens = readFileSync(path.resolve(import.meta.dirname, '../../../web/styles/tokens.css'), 'utf8');
    const rule = tokens.slice(tokens.lastIndexOf(`[data-theme='${theme}']`));
    for (const [name, colour] of Object.entries({ leader, reactor }))
      expect(rule.slice(0, rule.indexOf('}'))).toContain(`--${name}-body: #${colour.toString(16)};`);
  });
});
