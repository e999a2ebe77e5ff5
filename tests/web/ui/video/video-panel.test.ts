import { expect, it } from 'vitest';
import { coveredBy } from '../../../../web/ui/video/video-panel';

it('dancers stand beside a panel, except where it leaves less than half of the stage', () => {
  // A wide window, and a phone: the panel has 38 % of its width.
  expect(coveredBy(312, 1280)).toBe(312);
  expect(coveredBy(160, 390)).toBe(160);
  // While a person is chosen on a phone, the panel spans it.
  expect(coveredBy(378, 390)).toBe(0);
  // While the panel is hidden.
  expect(coveredBy(0, 390)).toBe(0);
});
