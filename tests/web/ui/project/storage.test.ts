import { isFull, isNewer } from '../../../../web/ui/project/database';
import 'fake-indexeddb/auto';
import { deleteDB, openDB } from 'idb';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { checked } from '../../../../web/ui/project/records';
import { storedProject, VERSION } from '../../../../web/ui/project/stored-project';
import { ProjectDatabase } from '../../../../web/ui/project/storage';
import * as change from '../../support/actions';
import { takeDeleted, takeRenamed } from '../../../../web/ui/store/actions/takes';
import { currentInputs } from '../../../../web/ui/store/take';
import { leader, numbered, song } from '../../support/made-state';
import { small } from '../../support/small-manifest';

function withTakes(...ids: string[]): change.Store {
  const store = change.createAppStore('dark');
  change.apply(store, change.manifestLoaded(small, 7));
  change.apply(store, change.leaderLoaded(leader(30)));
  change.apply(store, change.songLoaded(song(2)));
  ids.forEach((id, index) => {
    change.apply(store, change.seedSet(index));
    const inputs = currentInputs(store.getState())!;
    const reaction = { motion: numbered(30, index), latents: null, inputs, label: null, seconds: 1 };
    change.apply(store, change.reactionAdded(reaction, { id, at: 1e6 * (index + 1) }));
  });
  return store;
}

/** How the stand-in for the browser's IndexedDB ends a transaction with an error. */
interface Aborted {
  _abort(error: string): void;
}

const read = async (name: string) => checked((await new ProjectDatabase(name).read())!).project;
const count = async (name: string, part: string) => (await openDB(name)).count(part);

it('keeps everything, writes what has changed, and removes what has left', async () => {
  const database = new ProjectDatabase('all');
  const store = withTakes('a', 'b');
  expect(await database.read()).toBeNull();
  await database.write(storedProject(store.getState()));
  const { takes, motions, page } = storedProject(store.getState());
  expect(await read('all')).toMatchObject({ takes: [takes[0], takes[1]], page });
  expect(new Set((await read('all')).motions)).toEqual(new Set(motions));
  change.apply(store, takeRenamed('a', 'Softer hands'));
  change.apply(store, takeDeleted('b'));
  await database.write(storedProject(store.getState()));
  expect((await read('all')).takes).toMatchObject([{ id: 'a', name: 'Softer hands' }]);
  expect(await count('all', 'motions')).toBe(1);
});

it('a write that fails in the middle changes nothing', async () => {
  const database = new ProjectDatabase('atomic');
  await database.write(storedProject(withTakes('a').getState()));
  const broken = storedProject(withTakes('b', 'c').getState());
  // A function can't be stored: the transaction ends there.
  const takes = [broken.takes[0]!, { ...broken.takes[1]!, seconds: (() => 1) as unknown as number }];
  await expect(database.write({ ...broken, takes })).rejects.toThrow();
  expect((await read('atomic')).takes.map(({ id }) => id)).toEqual(['a']);
  expect(await count('atomic', 'motions')).toBe(1);
});

it('writes everything again after the browser has deleted what it kept', async () => {
  const database = new ProjectDatabase('deleted');
  const store = withTakes('a');
  await database.read();
  await database.write(storedProject(store.getState()));
  await deleteDB('deleted');
  change.apply(store, takeRenamed('a', 'Softer hands'));
  await database.write(storedProject(store.getState()));
  const { songs, leaders, motions, takes, page } = await read('deleted');
  expect(takes).toMatchObject([{ id: 'a', name: 'Softer hands' }]);
  expect([songs, leaders, motions].map(({ length }) => length)).toEqual([1, 1, 1]);
  expect(page).not.toBeNull();
});

describe('a storage with room for one motion', () => {
  /** Motions that fit; a transaction with more of them ends as it does in a browser whose storage is full. */
  let room: number;
  /** The part of which there is room for so many. */
  let limited: string;
  const original = Object.getOwnPropertyDescriptor(IDBObjectStore.prototype, 'put')!;
  beforeEach(() => {
    room = 1;
    limited = 'motions';
    const put = original.value as (
      this: IDBObjectStore,
      value: unknown,
      key?: IDBValidKey,
    ) => IDBRequest<IDBValidKey>;
    IDBObjectStore.prototype.put = function (this: IDBObjectStore, ...record: Parameters<typeof put>) {
      const request = put.apply(this, record);
      if (this.name === limited)
        this.count().onsuccess = ({ target }) => {
          const full = (target as IDBRequest<number>).result > room;
          if (full) (this.transaction as unknown as Aborted)._abort('QuotaExceededError');
        };
      return request;
    };
  });
  afterEach(() => {
    Object.defineProperty(IDBObjectStore.prototype, 'put', original);
  });

  it('keeps the takes and the page that fit, says that it is full, and keeps the rest when there is room', async () => {
    const database = new ProjectDatabase('full');
    const project = storedProject(withTakes('a', 'b').getState());
    await expect(database.write(project)).rejects.toSatisfy(isFull);
    expect((await read('full')).takes).toHaveLength(1);
    expect((await read('full')).page).toEqual(project.page);
    expect(await count('full', 'motions')).toBe(1);

    await expect(database.write(project)).rejects.toSatisfy(isFull);
    room = 2;
    await database.write(project);
    expect((await read('full')).takes.map(({ id }) => id).sort()).toEqual(['a', 'b']);
  });

  it('keeps the page of before where the leader of the new one does not fit', async () => {
    limited = 'leaders';
    const database = new ProjectDatabase('leader');
    const store = withTakes('a');
    const before = storedProject(store.getState()).page.leader;
    await database.write(storedProject(store.getState()));
    change.apply(store, change.leaderLoaded(leader(60)));
    await expect(database.write(storedProject(store.getState()))).rejects.toSatisfy(isFull);
    expect((await database.read())?.page).toMatchObject({ leader: before });
  });

  it('keeps a change of a take beside a new one that does not fit, and removes what has left before it adds', async () => {
    const database = new ProjectDatabase('exchange');
    const store = withTakes('a');
    await database.write(storedProject(store.getState()));
    change.apply(store, takeRenamed('a', 'Softer hands'));
    const other = storedProject(withTakes('b').getState());
    const old = storedProject(store.getState());
    const takes = [...other.takes, ...old.takes];
    const both = { ...old, motions: [...other.motions, ...old.motions], takes };
    await expect(database.write(both)).rejects.toSatisfy(isFull);
    expect((await read('exchange')).takes).toMatchObject([{ id: 'a', name: 'Softer hands' }]);

    await database.write(other);
    expect((await read('exchange')).takes.map(({ id }) => id)).toEqual(['b']);
  });
});

it('leaves what a newer page has written alone', async () => {
  const newer = await openDB('newer', VERSION + 1, {
    upgrade: (database) => void database.createObjectStore('takes'),
  });
  await newer.put('takes', 'of tomorrow', 'a');
  newer.close();
  const database = new ProjectDatabase('newer');
  await expect(database.read()).rejects.toSatisfy(isNewer);
  await expect(database.write(storedProject(withTakes('b').getState()))).rejects.toSatisfy(isNewer);
  await expect(database.clear()).rejects.toSatisfy(isNewer);
  const again = await openDB('newer');
  expect(await again.getAll('takes')).toEqual(['of tomorrow']);
});

it('converts the leaders that the first version of the page stored', async () => {
  const first = await openDB('first', 1, {
    upgrade: (database) => {
      for (const part of ['songs', 'leaders', 'motions', 'takes'])
        database.createObjectStore(part, { keyPath: 'id' });
      database.createObjectStore('page');
    },
  });
  await first.put('leaders', { id: 'a', name: 'old.bvh', label: null, text: 'HIERARCHY', fps: 60 });
  await first.put('page', { leader: 'a' }, 'now');
  first.close();
  const { leaders } = await read('first');
  expect(leaders).toMatchObject([{ name: 'old.bvh', options: { fps: 60 } }]);
  expect(new TextDecoder().decode(leaders[0]?.files[0]?.bytes)).toBe('HIERARCHY');
});

it('leaves the leader and the song that a take of another tab refers to', async () => {
  const theirs = withTakes('b');
  await new ProjectDatabase('shared').write(storedProject(theirs.getState()));
  const database = new ProjectDatabase('shared');
  await database.read();
  const mine = withTakes();
  change.apply(mine, change.leaderLoaded(theirs.getState().leader!));
  change.apply(mine, change.songLoaded(theirs.getState().song!));
  await database.write(storedProject(mine.getState()));
  change.apply(mine, change.leaderLoaded(leader(60)));
  change.apply(mine, change.songLoaded(song(3)));
  await database.write(storedProject(mine.getState()));
  const { takes } = await read('shared');
  expect(takes).toMatchObject([{ id: 'b', song: expect.any(String) as string }]);
});

it('writes takes again that it has removed, as when starting over is undone', async () => {
  const database = new ProjectDatabase('again');
  const project = storedProject(withTakes('a').getState());
  await database.write(project);
  await database.removeOwn();
  expect(await count('again', 'takes')).toBe(0);
  await database.write(project);
  expect((await read('again')).takes.map(({ id }) => id)).toEqual(['a']);
});

it('removes its own records, and leaves what it could not restore until everything is cleared', async () => {
  const database = new ProjectDatabase('own');
  await database.write(storedProject(withTakes('a').getState()));
  const raw = await openDB('own');
  await raw.put('takes', { id: 'torn', number: 'first' });
  await database.removeOwn();
  expect(await raw.getAllKeys('takes')).toEqual(['torn']);
  await database.clear();
  expect(await raw.count('takes')).toBe(0);
  raw.close();
});
