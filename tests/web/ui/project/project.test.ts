import { afterEach, beforeEach, describe, expect, it, type Mock, vi } from 'vitest';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import { openedText, Project } from '../../../../web/ui/project/project';
import type { FoundProject } from '../../../../web/ui/project/records';
import { writeProject } from '../../../../web/ui/project/project-file';
import { storedProject } from '../../../../web/ui/project/stored-project';
import { countingsRestored } from '../../../../web/ui/store/actions/counting';
import { takeDeleted } from '../../../../web/ui/store/actions/takes';
import { regionSet } from '../../../../web/ui/store/actions/timeline';
import { undone } from '../../../../web/ui/store/history/history';
import type { FileReaders } from '../../../../web/ui/store/services';
import type { SongCounting } from '../../../../web/ui/store/state';
import { currentInputs } from '../../../../web/ui/store/take';
import * as change from '../../support/actions';
import { leader, leaderFile, numbered, song, songData, still } from '../../support/made-state';
import { small } from '../../support/small-manifest';

it('an opened project is named by song, leader and number of takes', () => {
  const files = { song: song(3), leader: leader(30) };
  const names = `${files.song.name}, ${files.leader.name}`;
  expect(openedText({ ...files, takes: [] })).toBe(`Opened: ${names}, no takes`);
  expect(openedText({ song: null, leader: files.leader, takes: [] })).toContain('no song');
});

const noVideos = { openVideo: () => Promise.resolve(), cancel: () => undefined };

/** A page with a take for each leader, the last of which is on the page. */
function pageOf(...leaders: readonly string[]): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  for (const name of leaders) {
    change.apply(store, change.leaderLoaded(leader(30, name)));
    const inputs = currentInputs(store.getState())!;
    const reaction = { motion: numbered(30, 1), latents: null, inputs, label: null, seconds: 1 };
    change.apply(store, change.reactionAdded(reaction, { id: `of ${name}`, at: 1e6 * name.length }));
  }
  return store;
}

/** How a song was counted. */
const COUNTED: SongCounting = { song: 'a.mp3', bytes: 3, beatsPerBar: 3, rate: 2, one: 0.5 };

/** The project file of a page with a take for each leader. */
async function fileOf(...leaders: readonly string[]): Promise<File> {
  return new File([await writeProject(storedProject(pageOf(...leaders).getState()))], 'new.zip');
}

describe('a project', () => {
  let store: change.Store;
  let project: Project;
  let files: FileLoader;
  /** By the names of leaders and the contents of songs: what their reading waits for, and what lets it go on. */
  let held: Map<string, { readonly wait: Mock<() => Promise<void>>; readonly goOn: () => void }>;
  const hold = (name: string): void => {
    let goOn = (): void => undefined;
    const going = new Promise<void>((resolve) => (goOn = resolve));
    held.set(name, { wait: vi.fn(() => going), goOn });
  };
  /** Resolves when something that is held is being read. */
  const reached = (name: string): Promise<void> =>
    vi.waitFor(() => expect(held.get(name)?.wait).toHaveBeenCalled());
  const goOn = (name: string): void => held.get(name)?.goOn();
  const takes = (): string[] => store.getState().takes.map(({ id }) => id);
  /** Resolves when all of an earlier visit is back. */
  const restoredAll = () => vi.waitFor(() => expect(store.getState().restoring).toBeNull());
  /** Lets everything happen that does not wait for what is held, where nothing may come of it. */
  const pass = () => new Promise((resolve) => setTimeout(resolve, 50));

  /** Opens the page in a browser in which an earlier visit has stored this. */
  const visit = (found: FoundProject | null): void => {
    store = change.createAppStore('dark');
    const readers: FileReaders = {
      loadSong: async (file) => {
        await held.get(await file.text())?.wait();
        return songData(3);
      },
      readLeader: async ({ files }) => {
        await held.get(files[0]!.name)?.wait();
        if (files[0]!.name === 'broken.bvh') throw new Error('It has no joints.');
        return { file: leaderFile(30), motion: still(30) };
      },
      manifest: () => {
        if (!store.getState().manifest) change.apply(store, change.manifestLoaded(small, 7));
        return Promise.resolve(small);
      },
    };
    files = new FileLoader(store, readers, noVideos);
    project = new Project(store, files, readers, {
      stage: () => null,
      storage: {
        read: () => Promise.resolve(found),
        write: () => Promise.resolve(),
        removeOwn: () => Promise.resolve(),
        clear: () => Promise.resolve(),
      },
      tabs: { name: 'tabs', locks: undefined, channel: undefined },
      persistence: { persisted: () => Promise.resolve(true), persist: () => Promise.resolve(true) },
    });
  };

  beforeEach(() => {
    held = new Map();
  });
  afterEach(() => {
    project.dispose();
  });

  /** What an earlier visit stored: takes for two leaders, and how a song was counted. */
  const stored = (): FoundProject => {
    const earlier = pageOf('second.bvh', 'first.bvh');
    change.apply(earlier, countingsRestored([COUNTED]));
    return { ...storedProject(earlier.getState()), songs: [] };
  };

  it('opened while an earlier visit is still being read replaces all of it, and undo brings all back', async () => {
    visit(stored());
    hold('second.bvh');
    expect(await project.restore()).toBe(true);
    expect(takes()).toEqual(['of first.bvh']);
    change.apply(store, change.givenSet({ songs: [], leaders: [], unused: [] }));
    const opened = project.open(await fileOf('new.bvh'));
    expect(store.getState().given, 'files to choose from are no longer wanted').toBeNull();
    await pass();
    goOn('second.bvh');
    expect(await opened).toBe(true);
    expect(takes()).toEqual(['of new.bvh']);
    change.apply(store, undone());
    expect(takes().sort()).toEqual(['of first.bvh', 'of second.bvh']);
  });

  it('of an earlier visit comes back without a take that is deleted while the others are read', async () => {
    visit(stored());
    hold('second.bvh');
    await project.restore();
    change.apply(store, takeDeleted('of first.bvh'));
    goOn('second.bvh');
    await restoredAll();
    expect(takes()).toEqual(['of second.bvh']);
  });

  it('of an earlier visit keeps how songs were counted when the visitor opens a leader before it is read', async () => {
    visit(stored());
    hold('first.bvh');
    const restored = project.restore();
    await reached('first.bvh');
    await files.openLeader({
      name: 'newer.bvh',
      label: null,
      files: [{ name: 'newer.bvh', bytes: new Uint8Array() }],
      options: {},
    });
    goOn('first.bvh');
    await restored;
    await restoredAll();
    expect(store.getState()).toMatchObject({ leader: { name: 'newer.bvh' }, countings: [COUNTED] });
    expect(takes().sort()).toEqual(['of first.bvh', 'of second.bvh']);
  });

  it('of an earlier visit comes back with the song that the visitor opens before it is read', async () => {
    visit(stored());
    hold('first.bvh');
    const restored = project.restore();
    await reached('first.bvh');
    await files.openSong(new Blob(['newer song']), 'newer.mp3', null);
    goOn('first.bvh');
    await restored;
    const { song, leader, reaction, countings } = store.getState();
    expect([song?.name, leader?.name]).toEqual(['newer.mp3', 'first.bvh']);
    expect(reaction).not.toBeNull();
    expect(countings).toEqual([COUNTED]);
  });

  it('of an earlier visit with a song alone comes back with its playhead and loop', async () => {
    const earlier = pageOf();
    change.apply(earlier, change.songLoaded(song(10)));
    change.apply(earlier, regionSet({ from: 2, to: 4 }));
    change.apply(earlier, change.playbackSet({ time: 3 }));
    const found = storedProject(earlier.getState());
    const bytes = new TextEncoder().encode('song');
    visit({
      ...found,
      songs: found.songs.map(({ id, name, label }) => ({ id, name, label, type: '', bytes })),
    });
    await project.restore();
    expect(store.getState()).toMatchObject({
      song: { name: song(10).name },
      playback: { time: 3, region: { from: 2, to: 4 }, loop: true },
    });
  });

  it.for(['before', 'after'])(
    'has no song where the demo’s was being read, which ends %s it',
    async (order) => {
      visit(null);
      await project.restore();
      hold('demo song');
      hold('new.bvh');
      void files.openSong(new Blob(['demo song']), 'demo.ogg', 'demo');
      await reached('demo song');
      const opened = project.open(await fileOf('new.bvh'));
      await reached('new.bvh');
      for (const name of order === 'before' ? ['demo song', 'new.bvh'] : ['new.bvh', 'demo song']) {
        goOn(name);
        await pass();
      }
      expect(await opened).toBe(true);
      expect(store.getState()).toMatchObject({ song: null, reading: { song: null } });
      expect(takes()).toEqual(['of new.bvh']);
    },
  );

  it('whose leader cannot be read leaves the page as it is', async () => {
    visit(null);
    await project.restore();
    expect(await project.open(await fileOf('page.bvh'))).toBe(true);
    expect(await project.open(await fileOf('other.bvh', 'broken.bvh'))).toBe(false);
    expect(takes()).toEqual(['of page.bvh']);
    expect(store.getState().leader?.name).toBe('page.bvh');
    expect(store.getState().problem).not.toBeNull();
  });

  it('that is given while an older one is still being read is the one that is opened', async () => {
    visit(null);
    await project.restore();
    hold('newer.bvh');
    hold('old.bvh');
    const older = project.open(await fileOf('old.bvh', 'page.bvh'));
    await reached('old.bvh');
    const newer = project.open(await fileOf('newer.bvh'));
    await reached('newer.bvh');
    goOn('old.bvh');
    expect(await older).toBe(false);
    expect(store.getState().restoring?.what).toContain('newer.bvh');
    goOn('newer.bvh');
    expect(await newer).toBe(true);
    expect(takes()).toEqual(['of newer.bvh']);
    expect(store.getState().restoring).toBeNull();
  });

  it('gives way to a leader that is asked for while it is still being read', async () => {
    visit(null);
    await project.restore();
    hold('of a take.bvh');
    hold('newer.bvh');
    const opened = project.open(await fileOf('of a take.bvh', 'page.bvh'));
    await pass();
    const asked = files.open([new File(['HIERARCHY\nROOT Hips'], 'newer.bvh')]);
    await pass();
    goOn('of a take.bvh');
    expect(await opened).toBe(false);
    goOn('newer.bvh');
    await asked;
    expect(store.getState()).toMatchObject({ leader: { name: 'newer.bvh' }, takes: [], restoring: null });
  });
});
