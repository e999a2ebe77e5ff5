import { afterEach, describe, expect, it, vi } from 'vitest';
import { loadDemo } from '../../../../web/ui/files/demo';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import * as change from '../../support/actions';
import { leaderFile, madeSettings, songData, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

describe('the demo’s ready-made reaction', () => {
  const settings = { ...madeSettings, seed: 1206, music: 8 };
  const named = (file: string): object => ({ file, name: file, label: `demo ${file}` });
  /** After the dancers are shown, and before the song is read. */
  type Act = (store: change.Store) => void;

  /**
   * Loads a demo whose reaction was made by the model with this id; the visitor does something meanwhile.
   * @param songAnswer where it is given, the song's download ends only after that, well or not
   */
  const load = async (
    model: string,
    act: Act = () => undefined,
    songAnswer: boolean | null = null,
  ): Promise<change.Store> => {
    const store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    const reactor = { file: 'reactor', label: 'demo reaction', model, settings };
    const demo = JSON.stringify({ song: named('song'), leader: named('leader'), reactor });
    let goOn = (): void => undefined;
    const held = new Promise<void>((resolve) => (goOn = resolve));
    vi.stubGlobal('fetch', async ({ pathname }: URL) => {
      if (pathname.endsWith('/song') && songAnswer !== null) await held;
      const status = pathname.endsWith('/song') && songAnswer === false ? 503 : 200;
      return new Response(pathname.endsWith('.json') ? demo : 'content', { status });
    });
    const readers = {
      loadSong: () => held.then(() => songData(1)),
      readLeader: () => Promise.resolve({ file: leaderFile(30), motion: still(30) }),
      manifest: () => Promise.resolve(small),
    };
    const videos = { openVideo: () => Promise.resolve(), cancel: () => undefined };
    const loading = loadDemo(
      store,
      new FileLoader(store, readers, videos),
      new URL('https://page.example/demo/'),
      { readReactor: () => Promise.resolve(still(30)), manifest: readers.manifest },
    );
    await vi.waitUntil(() => store.getState().leader !== null);
    await new Promise((resolve) => setTimeout(resolve, 20));
    act(store);
    goOn();
    await loading;
    return store;
  };

  afterEach(() => {
    vi.unstubAllGlobals();
  });

  it('is shown before its song is read, and again with it, as its model’s, with its settings', async () => {
    const store = await load(small.id, ({ getState }) => {
      expect(getState().reaction).toMatchObject({ label: 'demo reaction', inputs: { song: null } });
    });
    const { takes, ...state } = store.getState();
    expect(state).toMatchObject({
      settings,
      reaction: { label: 'demo reaction', model: { id: small.id }, inputs: { song: { name: 'song' } } },
    });
    expect(takes).toHaveLength(1);
  });

  it('is left out with another model, which keeps its own settings', async () => {
    const store = await load('another model');
    expect(store.getState()).toMatchObject({
      leader: { name: 'leader' },
      song: { name: 'song' },
      reaction: null,
      takes: [],
      settings: { seed: 7, music: small.guidance.music.default },
    });
  });

  it('shows the couple while its song is still on its way, or cannot be had', async () => {
    const store = await load(
      small.id,
      ({ getState }) => {
        const { reaction, reading, demo } = getState();
        expect([reaction?.label, reading.song?.name, demo]).toEqual(['demo reaction', 'song', 'loading']);
      },
      false,
    );
    expect(store.getState()).toMatchObject({
      demo: 'ready',
      reading: { song: null },
      song: null,
      reaction: { label: 'demo reaction', model: { id: small.id } },
    });
  });

  it('keeps its song from a visitor who has brought a leader before it came', async () => {
    const store = await load(
      small.id,
      (page) => {
        const own = { ...page.getState().leader!, name: 'own', label: null };
        change.apply(page, change.leaderLoaded(own));
      },
      true,
    );
    expect(store.getState()).toMatchObject({ leader: { name: 'own' }, song: null, reading: { song: null } });
  });

  it('does not come back in the other role when the roles are swapped while its song is read', async () => {
    const store = await load(small.id, (page) => {
      change.apply(page, change.rolesSwapped());
    });
    expect(store.getState().settings?.role).toBe('leader');
    expect(store.getState().reaction).toBeNull();
  });
});
