import { expect, it } from 'vitest';
import { cardContents } from '../../../../web/ui/generation/variation-cards';
import type { Reaction } from '../../../../web/ui/store/reaction';
import type { Variations } from '../../../../web/ui/store/state';
import { leader, madeSettings, still } from '../../support/made-state';

const inputs = { leader: leader(30), song: null, shift: 0, settings: madeSettings };
const reaction: Reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
const empty = { seed: 5, reaction: null, fraction: 0 };

it('the reaction on the stage keeps its card where making others is cancelled before one is there', () => {
  const variations: Variations = { inputs, firstSeed: 5, making: true, list: [empty, empty, empty] };
  const first = (more: Partial<Variations>): Reaction | null | undefined =>
    cardContents({ variations: { ...variations, ...more }, reaction })[0]?.reaction;
  expect(first({})).toBeNull();
  expect(first({ making: false })).toBe(reaction);
  const other = { ...reaction };
  expect(first({ making: false, list: [{ ...empty, reaction: other }, empty, empty] })).toBe(other);
});
