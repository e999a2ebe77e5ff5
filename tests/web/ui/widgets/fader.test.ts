import { expect, it } from 'vitest';
import { valueText } from '../../../../web/ui/widgets/fader';

const range = { min: -0.5, max: 2, step: 0.05, default: 0 };

it.each([
  [0, '0.00, default'],
  [0.5, '0.50, a little towards larger'],
  [1, '1.00, towards larger'],
  [1.5, '1.50, far towards larger'],
  [2, '2.00, larger'],
  [-0.1, '-0.10, a little towards looser'],
  [-0.5, '-0.50, looser'],
])('a screen reader says how far %f is from the default', (value, text) => {
  expect(valueText('coarse', value, range)).toBe(text);
});

it('a control whose default is an end has a text too', () => {
  const song = { min: 0, max: 4, step: 0.25, default: 4 };
  expect(valueText('music', 4, song)).toBe('4.00, default');
  expect(valueText('music', 0, song)).toBe('0.00, less song');
});
