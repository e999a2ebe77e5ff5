/** What of a stored page does not fit what was read again. */
import { describe, expect, it } from 'vitest';
import { packFloats, unpackFloats } from '../../../../web/ui/project/motion-bytes';
import { Restorer } from '../../../../web/ui/project/restore';
import {
  hasVisitorContent,
  storedProject,
  type StoredProject,
} from '../../../../web/ui/project/stored-project';
import { takeStarred } from '../../../../web/ui/store/actions/takes';
import type { AppState } from '../../../../web/ui/store/state';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { leader, leaderFile, song, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

const LATENTS = Math.ceil(30 / small.latent.stride) * small.latent.layers.length * small.latent.channels;

/** A page whose takes have these latents, each a take of another seed. */
function page(...latents: readonly number[]): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  change.apply(store, change.leaderLoaded(leader(30)));
  latents.forEach((length, index) => {
    change.apply(store, change.seedSet(index));
    const inputs = currentInputs(store.getState())!;
    const reaction = {
      motion: still(30),
      latents: new Float32Array(length),
      inputs,
      label: null,
      seconds: 1,
    };
    change.apply(store, change.reactionAdded(reaction, { id: `t${index}`, at: 1e6 * (index + 1) }));
  });
  return store;
}

async function restored(stored: StoredProject): Promise<Partial<AppState>> {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  const restorer = new Restorer(stored);
  await restorer.readRest({
    song: () => Promise.resolve(null),
    leader: (one) => Promise.resolve({ ...one, file: leaderFile(30), motion: still(30) }),
  });
  return restorer.content(store.getState());
}

describe('a page that is restored', () => {
  it('has its playhead within the dance', async () => {
    const stored = storedProject(page(LATENTS).getState());
    const { playback } = await restored({ ...stored, page: { ...stored.page, time: 99 } });
    expect(playback?.time).toBe(1);
  });

  it('counts takes on from the highest number among them', async () => {
    const stored = storedProject(page(LATENTS, LATENTS).getState());
    expect((await restored({ ...stored, page: { ...stored.page, takesMade: 0 } })).takesMade).toBe(2);
  });

  it('does not show a take that was made for another leader than that of the page', async () => {
    const store = page(LATENTS);
    change.apply(store, change.leaderLoaded(leader(30, 'other.bvh')));
    const stored = storedProject(store.getState());
    const content = await restored({ ...stored, page: { ...stored.page, shown: 't0' } });
    expect(content.leader?.name).toBe('other.bvh');
    expect(content.takes).toHaveLength(1);
    expect(content.reaction).toBeNull();
  });

  it('leaves out latents of another length than the dance', async () => {
    const { takes } = await restored(storedProject(page(LATENTS, LATENTS + 1).getState()));
    expect(takes?.map(({ reaction }) => reaction.latents?.length ?? null)).toEqual([null, LATENTS]);
  });
});

it('packed floats are read from wherever they lie in a file', () => {
  const packed = packFloats(Float32Array.of(1, 2), Float32Array.of(3));
  expect([...unpackFloats(packed.subarray(4))]).toEqual([2, 3]);
});

it('a star and a counting of the own song are work of the visitor, a demo and its count are not', () => {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  const demo = { ...song(4), label: 'demo song' };
  change.apply(store, change.leaderLoaded({ ...leader(30), label: 'demo leader' }));
  change.apply(store, change.songLoaded(demo));
  const inputs = currentInputs(store.getState())!;
  const reaction = { motion: still(30), latents: null, inputs, label: 'demo reaction', seconds: null };
  change.apply(store, change.reactionAdded(reaction, { id: 'demo', at: 1e6 }));
  const counting = { song: demo.name, bytes: demo.file.size, beatsPerBar: 3, rate: 1, one: 0 } as const;
  store.setState({ countings: [counting] });
  expect(hasVisitorContent(store.getState())).toBe(false);
  store.setState({ countings: [counting, { ...counting, song: 'own.mp3' }] });
  expect(hasVisitorContent(store.getState())).toBe(true);
  store.setState({ countings: [] });
  expect(hasVisitorContent(store.getState())).toBe(false);
  change.apply(store, takeStarred('demo'));
  expect(hasVisitorContent(store.getState())).toBe(true);
});
