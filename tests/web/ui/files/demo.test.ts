import { afterEach, describe, expect, it, vi } from 'vitest';
import type { SolvedMotion } from '../../../../web/motion/skeleton/clip';
import { loadDemo } from '../../../../web/ui/files/demo';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import { countedBeats } from '../../../../web/ui/store/counting';
import { hasVisitorContent } from '../../../../web/ui/project/stored-project';
import { Generation } from '../../../../web/ui/generation/generation';
import { ManualGenerator } from '../../support/manual-generator';
import * as change from '../../support/actions';
import { leader, leaderFile, madeSettings, songData, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

describe('the demo’s ready-made reaction', () => {
  const settings = { ...madeSettings, seed: 1206, music: 8 };
  const named = (file: string): object => ({ file, name: file, label: `demo ${file}` });

  interface Loading {
    /** The model that made the reaction. */
    readonly model?: string;
    /** Called when the song is to be read, which waits for it. */
    readonly beforeSong?: () => Promise<void>;
    /** Where it is given, it is the song's download that waits for `beforeSong`, and ends well or not. */
    readonly songAnswer?: boolean | null;
    readonly readReactor?: () => Promise<SolvedMotion>;
  }

  const load = (
    store: change.Store,
    {
      model = small.id,
      beforeSong = () => Promise.resolve(),
      songAnswer = null,
      readReactor = () => Promise.resolve(still(30)),
    }: Loading,
  ): Promise<void> => {
    change.apply(store, change.manifestLoaded(small, 7));
    const reactor = { file: 'reactor', label: 'demo reaction', model, settings };
    const demo = JSON.stringify({ song: { ...named('song'), one: 1.6 }, leader: named('leader'), reactor });
    vi.stubGlobal('fetch', async ({ pathname }: URL) => {
      if (pathname.endsWith('/song') && songAnswer !== null) await beforeSong();
      const status = pathname.endsWith('/song') && songAnswer === false ? 503 : 200;
      return new Response(pathname.endsWith('.json') ? demo : 'content', { status });
    });
    const readers = {
      loadSong: () => (songAnswer === null ? beforeSong() : Promise.resolve()).then(() => songData(3)),
      readLeader: () => Promise.resolve({ file: leaderFile(30), motion: still(30) }),
      manifest: () => Promise.resolve(small),
    };
    const videos = { openVideo: () => Promise.resolve(), cancel: () => undefined };
    const files = new FileLoader(store, readers, videos);
    const folder = new URL('https://page.example/demo/');
    return loadDemo(store, files, folder, { readReactor, manifest: readers.manifest });
  };

  /** Loads it; the visitor does something after the dancers are shown and before the song is read. */
  const loadWhile = async (
    act: (store: change.Store) => void = () => undefined,
    { model = small.id, songAnswer = null }: Loading = {},
  ): Promise<change.Store> => {
    const store = change.createAppStore('dark');
    let goOn = (): void => undefined;
    const read = new Promise<void>((resolve) => (goOn = resolve));
    const beforeSong = vi.fn(() => read);
    const loading = load(store, { model, beforeSong, songAnswer });
    await vi.waitUntil(() => beforeSong.mock.calls.length > 0 && store.getState().leader !== null);
    if (model === small.id) await vi.waitUntil(() => store.getState().settings?.seed === settings.seed);
    act(store);
    goOn();
    await loading;
    return store;
  };

  afterEach(() => {
    vi.unstubAllGlobals();
  });

  it('is shown before its song is read, and again with it, as its model’s, with its settings', async () => {
    const store = await loadWhile(({ getState }) => {
      expect(getState().reaction).toMatchObject({ label: 'demo reaction', inputs: { song: null } });
    });
    const { takes, ...state } = store.getState();
    expect(state).toMatchObject({
      settings,
      reaction: { label: 'demo reaction', model: { id: small.id }, inputs: { song: { name: 'song' } } },
    });
    expect(takes).toHaveLength(1);
  });

  it('has its song counted as its file says, which is nothing of the visitor’s own', async () => {
    const store = await loadWhile();
    const beats = countedBeats(store.getState());
    expect(beats.times[beats.first]).toBe(1.5);
    expect(hasVisitorContent(store.getState())).toBe(false);
    change.apply(store, change.songLoaded({ ...store.getState().song!, label: null }));
    expect(hasVisitorContent(store.getState())).toBe(true);
  });

  it('is left out with another model, which keeps its own settings', async () => {
    const store = await loadWhile(undefined, { model: 'another model' });
    expect(store.getState()).toMatchObject({
      leader: { name: 'leader' },
      song: { name: 'song' },
      reaction: null,
      takes: [],
      settings: { seed: 7, music: small.guidance.music.default },
    });
  });

  it('shows the couple while its song is still on its way, or cannot be had', async () => {
    const store = await loadWhile(
      ({ getState }) => {
        const { reaction, reading, demo } = getState();
        expect([reaction?.label, reading.song?.name, demo]).toEqual(['demo reaction', 'song', 'loading']);
      },
      { songAnswer: false },
    );
    expect(store.getState()).toMatchObject({
      demo: 'ready',
      reading: { song: null },
      song: null,
      reaction: { label: 'demo reaction', model: { id: small.id } },
    });
  });

  it('keeps its song from a visitor who has brought a leader before it came', async () => {
    const store = await loadWhile(
      (page) => {
        const own = { ...page.getState().leader!, name: 'own', label: null };
        change.apply(page, change.leaderLoaded(own));
      },
      { songAnswer: true },
    );
    expect(store.getState()).toMatchObject({ leader: { name: 'own' }, song: null, reading: { song: null } });
  });

  it('keeps its song from a visitor who is opening one when it comes', async () => {
    const own = { name: 'own', fraction: 0.5 };
    const store = await loadWhile((page) => change.apply(page, change.readingSet('song', own)), {
      songAnswer: true,
    });
    expect(store.getState()).toMatchObject({ song: null, reading: { song: own }, demo: 'ready' });
  });

  it('does not come back in the other role when the roles are swapped while its song is read', async () => {
    const store = await loadWhile((page) => {
      change.apply(page, change.rolesSwapped());
    });
    expect(store.getState().settings?.role).toBe('leader');
    expect(store.getState().reaction).toBeNull();
  });

  it('has its song although another leader has come while that was read', async () => {
    const store = await loadWhile((page) => {
      change.apply(page, change.leaderLoaded(leader(60)));
    });
    const { reaction, takes } = store.getState();
    expect(reaction).toBeNull();
    expect(takes[0]?.reaction).toMatchObject({ model: { id: small.id }, inputs: { song: { name: 'song' } } });
  });

  it('keeps the page from making one of its own, also where it is read last', async () => {
    const store = change.createAppStore('dark');
    const model = new ManualGenerator();
    const generation = new Generation(store, () => Promise.resolve(model.generator));
    const calls: number[] = [];
    await load(store, {
      readReactor: async () => {
        await new Promise((resolve) => setTimeout(resolve, 50));
        calls.push(model.calls.length);
        return still(30);
      },
    });
    expect(calls).toEqual([0]);
    expect(store.getState()).toMatchObject({ job: null, reaction: { label: 'demo reaction' } });
    generation.dispose();
  });
});
