/** Which take a new reaction becomes beside a comparison, in a full list, and after what came ready-made. */
import { expect, it } from 'vitest';
import { MAX_TAKES } from '../../../../web/ui/store/add-take';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { leader, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

function page(): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  change.apply(store, change.leaderLoaded(leader(30)));
  return store;
}

/** The reaction to what is asked for now arrives, at a time in milliseconds. */
function arrive(store: change.Store, id: string, at: number, label: string | null = null): void {
  const inputs = currentInputs(store.getState())!;
  const reaction = { motion: still(30), latents: null, inputs, label, seconds: label === null ? 1 : null };
  change.apply(store, change.reactionAdded(reaction, { id, at }));
}

const ids = (store: change.Store): string[] => store.getState().takes.map(({ id }) => id);

it('does not replace a take that is being compared', () => {
  const store = page();
  arrive(store, 'a', 1000);
  store.setState({ other: 'a' });
  change.apply(store, change.musicSet(3));
  arrive(store, 'b', 2000);
  expect(ids(store)).toEqual(['b', 'a']);
  change.apply(store, change.musicSet(4));
  arrive(store, 'c', 3000);
  expect(ids(store), 'the next one of keys replaces the one before').toEqual(['b', 'a']);
});

it('keeps the take that is being compared when the list is full', () => {
  const store = page();
  for (let seed = 0; seed < MAX_TAKES; seed++) {
    change.apply(store, change.seedSet(seed));
    arrive(store, `t${seed}`, seed * 60_000);
  }
  store.setState({ other: 't0' });
  change.apply(store, change.seedSet(1000));
  arrive(store, 'new', 1e8);
  expect(ids(store)).toHaveLength(MAX_TAKES);
  expect(ids(store)).toContain('t0');
  expect(ids(store)).not.toContain('t1');
});

it('a ready-made reaction and one that is generated from the same are two takes', () => {
  const store = page();
  arrive(store, 'demo', 1000, 'demo reaction');
  arrive(store, 'own', 60_000);
  expect(ids(store)).toEqual(['own', 'demo']);
  expect(store.getState().takes.map(({ number }) => number)).toEqual([1, 0]);
});
