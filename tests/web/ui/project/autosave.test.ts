import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { yieldToPage } from '../../../../web/common/yield-to-events';
import { FileLoader } from '../../../../web/ui/files/file-loader';
import type { FileReaders } from '../../../../web/ui/store/services';
import type { TabLockApis } from '../../../../web/ui/project/tab-lock';
import type { FoundProject } from '../../../../web/ui/project/records';
import { storedProject, type StoredProject } from '../../../../web/ui/project/stored-project';
import { Project } from '../../../../web/ui/project/project';
import { notes, persistenceText } from '../../../../web/ui/store/selectors';
import * as change from '../../support/actions';
import { takeDeleted, takeRenamed } from '../../../../web/ui/store/actions/takes';
import { undone } from '../../../../web/ui/store/history/history';
import type { AppState } from '../../../../web/ui/store/state';
import { currentInputs } from '../../../../web/ui/store/take';
import { small } from '../../support/small-manifest';
import { leader, still } from '../../support/made-state';

const never = () => Promise.reject(new Error('Nothing is read here.'));
const readers: FileReaders = { loadSong: never, readLeader: never, manifest: () => Promise.resolve(small) };
const noVideos = { openVideo: () => Promise.resolve(), cancel: () => undefined };
interface Browser {
  /** What an earlier visit has stored. */
  readonly found: FoundProject | null;
  readonly tabs: TabLockApis;
  readonly readers: FileReaders;
}

/** A browser without an earlier visit and other tabs. */
const ALONE: Browser = { found: null, tabs: { name: 'tabs', locks: undefined, channel: undefined }, readers };

describe('autosave', () => {
  let store: change.Store;
  let project: Project;
  /** Titles of the takes as they were written, one write after the other. */
  let writes: (readonly (string | null)[])[];
  /** Takes that the browser has room for, and what it says when they are more. */
  let room: number;
  let failure: Error;
  /** The write that is under way. */
  let writing: Promise<void>;
  /** How often the storage was emptied of everything. */
  let emptied: number;
  /** How often the browser was asked to keep what is stored. */
  let asked: number;
  const made = (id: string): void => {
    const inputs = currentInputs(store.getState())!;
    const reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
    change.apply(store, change.seedSet(writes.length + id.length));
    change.apply(store, change.reactionAdded(reaction, { id, at: 1e6 * id.length }));
  };
  /** Lets the clock run, and a write that waits for a task of its own begin and end. */
  const pass = async (milliseconds: number): Promise<void> => {
    await vi.advanceTimersByTimeAsync(milliseconds);
    await yieldToPage();
    await vi.advanceTimersByTimeAsync(0);
  };
  const warnings = () => notes(store.getState()).filter(({ isWarning }) => isWarning);

  /** Opens the page in a browser with room for so many takes, -1 for nothing at all. */
  const visit = async (takes: number, { found, tabs, readers }: Browser = ALONE) => {
    writes = [];
    room = takes;
    failure = new DOMException('No room.', 'QuotaExceededError');
    store = change.createAppStore('dark');
    change.apply(store, change.manifestLoaded(small, 7));
    change.apply(store, change.leaderLoaded(leader(30)));
    project = new Project(store, new FileLoader(store, readers, noVideos), readers, {
      stage: () => null,
      storage: {
        read: () => Promise.resolve(found),
        write: ({ takes }: StoredProject) => {
          if (takes.length > room) return Promise.reject(failure);
          writes.push(takes.map(({ name }) => name));
          return writing;
        },
        removeOwn: () => Promise.resolve(),
        clear: () => {
          emptied++;
          return Promise.resolve();
        },
      },
      tabs,
      persistence: {
        persisted: () => Promise.resolve(false),
        persist: () => {
          asked++;
          return Promise.resolve(true);
        },
      },
    });
    asked = emptied = 0;
    writing = Promise.resolve();
    void project.restore();
    await pass(1000);
    writes = [];
  };

  beforeEach(async () => {
    vi.useFakeTimers();
    await visit(9);
  });
  afterEach(() => {
    project.dispose();
    vi.useRealTimers();
  });

  it('writes a take in the task after the one in which it is made, and asks the browser to keep it, once', async () => {
    change.apply(store, change.seedSet(5));
    await pass(0);
    writes = [];
    expect(asked).toBe(0);
    const inputs = currentInputs(store.getState())!;
    const reaction = { motion: still(30), latents: null, inputs, label: null, seconds: 1 };
    change.apply(store, change.reactionAdded(reaction, { id: 'a', at: 1e6 }));
    expect(writes).toEqual([]);
    await pass(0);
    expect(writes).toEqual([[null]]);
    expect(asked).toBe(1);
    made('bb');
    await pass(0);
    expect(asked).toBe(1);
    expect(persistenceText(store.getState())).toMatch(/promised to keep them/);
  });

  it('writes at once when the page is hidden, since it may end there', async () => {
    const page = Object.assign(new EventTarget(), { visibilityState: 'visible' });
    vi.stubGlobal('document', page);
    try {
      await visit(9);
      made('a');
      await pass(0);
      writes = [];
      page.visibilityState = 'hidden';
      page.dispatchEvent(new Event('visibilitychange'));
      expect(writes).toEqual([[null]]);
    } finally {
      vi.unstubAllGlobals();
    }
  });

  it('writes the newest change after the one that is being written, and not each playhead', async () => {
    made('a');
    await pass(0);
    writes = [];
    let written = (): void => undefined;
    writing = new Promise((resolve) => (written = resolve));
    change.apply(store, takeRenamed('a', 'One'));
    await pass(0);
    for (const name of ['Two', 'Three']) change.apply(store, takeRenamed('a', name));
    await pass(1000);
    expect(writes).toEqual([['One']]);
    writing = Promise.resolve();
    written();
    await pass(0);
    expect(writes).toEqual([['One'], ['Three']]);
    for (let frame = 0; frame < 60; frame++) {
      change.apply(store, change.playbackSet({ time: frame / 60 }));
      await pass(16);
    }
    expect(writes).toHaveLength(2);
  });

  it('writes what else of the page is kept: how it is counted, drawn, compared and repeated', async () => {
    made('a');
    made('bb');
    await pass(0);
    const { playback } = store.getState();
    const region = { from: 0.1, to: 0.6 };
    const counting = { song: 'a.mp3', bytes: 3, beatsPerBar: 3, rate: 2, one: 0.5 } as const;
    const patches: readonly Partial<AppState>[] = [
      { footLock: !store.getState().footLock },
      { countings: [counting] },
      { other: 'a' },
      { compare: 'ghost' },
      { letter: 'B' },
      { playback: { ...playback, region } },
      { playback: { ...playback, region, loop: !playback.loop } },
    ];
    for (const patch of patches) {
      writes = [];
      store.setState(patch);
      await pass(0);
      expect(writes, Object.keys(patch).join()).toHaveLength(1);
    }
  });

  it('writes no more where a newer page has written', async () => {
    room = 0;
    failure = new DOMException('Of tomorrow.', 'VersionError');
    made('a');
    await pass(0);
    expect(store.getState().autosave).toBe('newer');
    room = 9;
    made('bb');
    await pass(60_000);
    expect(writes).toEqual([]);
  });

  it('empties the storage of everything when the visitor starts afresh while a change is being written', async () => {
    let written = (): void => undefined;
    writing = new Promise((resolve) => (written = resolve));
    made('a');
    await pass(0);
    expect(writes).toHaveLength(1);
    project.clear();
    written();
    await pass(0);
    expect(emptied).toBe(1);
  });

  it('keeps what could not be restored when the visitor undoes starting over', async () => {
    made('a');
    await pass(0);
    project.clear();
    change.apply(store, undone());
    await pass(0);
    store.setState({ leader: null, takes: [] });
    await pass(0);
    expect(emptied).toBe(0);
  });

  it('reports once that the space is full, tries again by itself, and stops saying so when there is room', async () => {
    room = 1;
    made('a');
    made('bb');
    await pass(1000);
    expect(store.getState().problem).toMatchObject({ code: 'storage-full', remedy: 'project' });
    expect(warnings()).toEqual([{ isWarning: true, text: expect.stringContaining('is full') as string }]);
    change.apply(store, change.problemClosed());
    change.apply(store, takeRenamed('a', 'One'));
    writes = [];
    await pass(30_000);
    expect(store.getState().problem).toBeNull();
    expect(writes).toEqual([]);
    // Room was made elsewhere.
    room = 2;
    await pass(20_000);
    expect(writes).toEqual([[null, 'One']]);
    expect(warnings()).toEqual([]);
    await pass(60_000);
    expect(writes).toHaveLength(1);
  });

  it('goes on as soon as the visitor has made room', async () => {
    room = 1;
    made('a');
    made('bb');
    await pass(1000);
    writes = [];
    change.apply(store, takeDeleted('a'));
    await pass(1000);
    expect(writes).toEqual([[null]]);
    expect(store.getState().autosave).toBe('stored');
  });

  it('says that another tab has the work before it is read here', async () => {
    made('a');
    project.dispose();
    const taken = { request: (...[, , held]: Parameters<LockManager['request']>) => held(null) };
    await visit(9, {
      found: storedProject(store.getState()),
      tabs: { name: 'tabs', locks: taken as TabLockApis['locks'], channel: undefined },
      readers: { ...readers, manifest: () => new Promise(() => undefined) },
    });
    expect(store.getState().restoring).not.toBeNull();
    expect(store.getState().autosave).toBe('elsewhere');
  });

  it('only adds a note when there never was any room', async () => {
    project.dispose();
    await visit(-1);
    made('a');
    await pass(1000);
    expect(store.getState().autosave).toBe('full');
    expect(store.getState().problem).toBeNull();
    expect(warnings()).toEqual([{ isWarning: true, text: expect.stringContaining('is full') as string }]);
  });

  it('only adds a note when the browser stores nothing at all', async () => {
    room = 0;
    failure = new DOMException('Not in this window.', 'SecurityError');
    made('a');
    await pass(1000);
    expect(store.getState().problem).toBeNull();
    expect(warnings()[0]?.text).toContain('saves nothing');
  });
});
