import { expect, test } from 'vitest';
import type { Manifest } from '../../../../web/model/manifest';
import { modelIdentity, type Inputs, type Take } from '../../../../web/ui/store/reaction';
import type { AppState } from '../../../../web/ui/store/state';
import { initialState } from '../../../../web/ui/store/store';
import { fullTakeText, takeText } from '../../../../web/ui/takes/take-text';
import { retrained, small } from '../../support/small-manifest';
import { uniformGuidance, leader, song, still } from '../../support/made-state';

const music = small.guidance.music.default;
const settings = {
  guidance: uniformGuidance(2, 1.5),
  music,
  variety: small.guidance.variety.default,
  seed: 1204,
  role: 'reactor' as const,
  height: null,
  holdHands: true,
};
const inputs: Inputs = { leader: leader(300), song: song(10), shift: 0, settings };
const page: AppState = { ...initialState('dark'), manifest: small, leader: inputs.leader, song: inputs.song };
const take = (more: Partial<Inputs>): Take => ({
  id: 'id',
  number: 1,
  name: null,
  starred: false,
  createdAt: 0,
  reaction: { motion: still(300), latents: null, inputs: { ...inputs, ...more }, label: null, seconds: 1 },
});
const guided = 'seed 1204, 2 coarse, 1.5 fine';

test('the line of a take leaves out what is as on the page and as the model’s defaults', () => {
  expect(takeText(take({}), page)).toBe(guided);
});

test.each<[string, Partial<Inputs>]>([
  [`as leader, ${guided}`, { settings: { ...settings, role: 'leader' } }],
  [`song 1.70 s later, ${guided}`, { shift: 51 }],
  [`song 0.50 s earlier, ${guided}`, { shift: -15 }],
  [`song 0.03 s later, ${guided}`, { shift: 1 }],
  [`no song, ${guided}`, { song: null }],
  [`Descarga, ${guided}`, { song: song(4) }],
  [`to other, ${guided}`, { leader: leader(90, 'other.bvh') }],
  [`to my very own lea…, ${guided}`, { leader: leader(90, 'my very own leader.bvh') }],
  [`to 14 letters and💃…, ${guided}`, { leader: leader(90, '14 letters and💃💃💃.bvh') }],
  [`${guided}, ${music - 0.25} music`, { settings: { ...settings, music: music - 0.25 } }],
  [`${guided}, 1.5 variety`, { settings: { ...settings, variety: 1.5 } }],
  [`${guided}, free hands`, { settings: { ...settings, holdHands: false } }],
  [`${guided}, 172 cm tall`, { settings: { ...settings, height: 1.716 } }],
])('what sets a take apart comes first: %s', (words, more) => {
  expect(takeText(take(more), page)).toBe(words);
});

test('the line of a take names its model where it is another than the page’s', () => {
  const made = take({});
  const by = (manifest: Manifest): Take => ({
    ...made,
    reaction: { ...made.reaction, model: modelIdentity(manifest) },
  });
  expect(takeText(by(small), page)).toBe(guided);
  expect(takeText(by(retrained()), page)).toBe(`by Small, ${guided}`);
});

test('the tooltip of a take names all inputs', () => {
  expect(fullTakeText(take({ shift: 51 }))).toBe(
    `As reactor to leader_0412.bvh, with Descarga.mp3, song 1.70 s later, ` +
      `2.00 coarse, 1.50 fine, ${music.toFixed(2)} music, 1.00 variety, seed 1204`,
  );
});
