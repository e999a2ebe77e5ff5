import { afterEach, expect, it, vi } from 'vitest';
import { loadDemo } from '../../../../web/ui/files/demo';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import * as change from '../../support/actions';
import { leaderFile, songData, still, uniformGuidance } from '../../support/made-state';
import { small } from '../../support/small-manifest';

const DEMO = {
  song: { file: 'song.mp3', name: 'Song', label: 'demo song' },
  leader: { file: 'leader.bvh', name: 'Leader', label: 'demo leader' },
  reactor: {
    file: 'reactor.bvh',
    label: 'demo reaction',
    settings: { guidance: uniformGuidance(0, 0), music: 2, variety: 1, seed: 3, role: 'reactor' },
  },
};

afterEach(() => void vi.unstubAllGlobals());

/** Loads the demo; the visitor does something after its dancers are shown and before its song is read. */
async function loadedAfter(act: (store: change.Store) => void): Promise<change.Store> {
  vi.stubGlobal('fetch', (url: URL) =>
    Promise.resolve(new Response(url.pathname.endsWith('.json') ? JSON.stringify(DEMO) : 'anything')),
  );
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  let goOn = (): void => undefined;
  const held = new Promise<void>((resolve) => (goOn = resolve));
  const manifest = () => Promise.resolve(small);
  const files = new FileLoader(
    store,
    {
      loadSong: () => held.then(() => songData(2)),
      readLeader: () => Promise.resolve({ file: leaderFile(60), motion: still(60) }),
      manifest,
    },
    () => Promise.resolve(),
  );
  const readReactor = () => Promise.resolve(still(60));
  const loading = loadDemo(store, files, new URL('https://example.org/demo/'), { readReactor, manifest });
  await vi.waitUntil(() => store.getState().reaction !== null);
  act(store);
  goOn();
  await loading;
  return store;
}

it('the demo’s reaction is shown before its song is read, and again with the song', async () => {
  const store = await loadedAfter(() => undefined);
  const { reaction, takes, song } = store.getState();
  expect(reaction?.label).toBe('demo reaction');
  expect(reaction?.inputs.song).toBe(song);
  expect(takes).toHaveLength(1);
});

it('the demo’s reaction does not come back in the other role when the roles are swapped while its song is read', async () => {
  const store = await loadedAfter((page) => {
    change.apply(page, change.rolesSwapped());
  });
  expect(store.getState().settings?.role).toBe('leader');
  expect(store.getState().reaction).toBeNull();
});
