import { expect, it } from 'vitest';
import * as change from '../../support/actions';
import { barBeside } from '../../../../web/ui/store/bars';
import { musicBeats } from '../../../../web/ui/store/song-shift';
import { small } from '../../support/small-manifest';
import { leader, song } from '../../support/made-state';

it('a bar on and back is the start of a bar, and at the ends that of the dance', () => {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  change.apply(store, change.leaderLoaded(leader(300)));
  expect(barBeside(store.getState(), 4, -1)).toBe(3);
  change.apply(store, change.songLoaded(song(10)));
  const state = store.getState();
  const [first = NaN, , , , second = NaN] = musicBeats(state);
  expect(second).toBeGreaterThan(first);
  expect(barBeside(state, first, 1)).toBe(second);
  expect(barBeside(state, first + 0.2, 1)).toBe(second);
  expect(barBeside(state, second, -1)).toBe(first);
  expect(barBeside(state, second - 0.2, -1)).toBe(first);
  expect(barBeside(state, first, -1)).toBe(0);
  expect(barBeside(state, 9.99, 1)).toBe(10);
});
