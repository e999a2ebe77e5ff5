import { type DBSchema, type IDBPDatabase, openDB } from 'idb';
import type { Kept, KeptLeader, KeptMotion, KeptPage, KeptSong, KeptTake } from './schema';

/** A song in the database: its bytes, because not every browser keeps blobs in every window. */
interface StoredSong extends Omit<KeptSong, 'file'> {
  readonly bytes: ArrayBuffer;
  readonly type: string;
}

interface Schema extends DBSchema {
  songs: { key: string; value: StoredSong };
  leaders: { key: string; value: KeptLeader };
  motions: { key: string; value: KeptMotion };
  takes: { key: string; value: KeptTake };
  page: { key: 'now'; value: KeptPage };
}

const PARTS = ['songs', 'leaders', 'motions', 'takes'] as const;
type Part = (typeof PARTS)[number];
type Keys = Record<Part, Set<string>>;

/** Where the browser keeps songs, leaders, takes and settings between two visits. */
export interface Storage {
  /** Everything that is kept, or null when there is nothing. */
  readonly read: () => Promise<Kept | null>;
  /**
   * Removes what an earlier call was given and this one is not, and writes what is new or has changed. Where the space
   * is full, as much as fits is written before it rejects; no take loses what was kept of it.
   */
  readonly write: (kept: Kept) => Promise<void>;
  readonly clear: () => Promise<void>;
}

/** Whether the browser has no more space for the page. */
export function isFull(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'QuotaExceededError';
}

/**
 * The page's database. Every call rejects with the browser's own error where it gives no storage, as in private
 * windows, or when its space is full (`isFull`).
 */
export function openStorage(name = 'reactdance'): Storage {
  let opening: Promise<IDBPDatabase<Schema>> | null = null;
  const open = (): Promise<IDBPDatabase<Schema>> => {
    opening ??= openDB<Schema>(name, 1, {
      upgrade: (database) => {
        for (const part of PARTS) database.createObjectStore(part, { keyPath: 'id' });
        database.createObjectStore('page');
      },
      // Another tab has a newer page: it may go ahead, this one opens the database again when it needs it.
      blocking: (_now, _wanted, event) => {
        (event.target as IDBDatabase).close();
        opening = null;
      },
      terminated: () => {
        opening = null;
      },
    }).catch((error: unknown) => {
      opening = null;
      throw error;
    });
    return opening;
  };

  /** What lies in the database as far as this page knows, by id. Parts never change under their id; takes do. */
  let there: Keys = noKeys();
  /** What this page looks after. The rest is another tab's, or could not be brought back and may be one day. */
  let ours: Keys = noKeys();
  let takesThere = new Map<string, KeptTake>();
  let pageThere: KeptPage | null = null;

  /** Parts that something in the database refers to, which is not always what the page wants to have there. */
  const inUse = (): Keys => {
    const keys = noKeys();
    for (const { id, song, leader, motion } of [...takesThere.values()]) {
      keys.takes.add(id);
      keys.motions.add(motion);
      keys.leaders.add(leader);
      if (song !== null) keys.songs.add(song);
    }
    if (pageThere?.song) keys.songs.add(pageThere.song);
    if (pageThere?.leader) keys.leaders.add(pageThere.leader);
    return keys;
  };
  /** Removes takes that have left the page, and then what nothing in the database refers to any more. */
  const remove = async (wanted: Keys): Promise<void> => {
    const gone = [...ours.takes].filter((id) => !wanted.takes.has(id));
    for (const id of gone) takesThere.delete(id);
    const needed = inUse();
    const leaving = PARTS.flatMap((part) =>
      [...ours[part]]
        .filter((id) => !wanted[part].has(id) && !needed[part].has(id))
        .map((id) => ({ part, id })),
    );
    if (leaving.length === 0) return;
    const transaction = (await open()).transaction(PARTS, 'readwrite');
    await settled([
      transaction.done,
      ...leaving.map(({ part, id }) => transaction.objectStore(part).delete(id)),
    ]);
    for (const { part, id } of leaving) {
      ours[part].delete(id);
      there[part].delete(id);
    }
  };
  /** Writes what is missing of these, all of it or nothing. */
  const add = async ({ songs, leaders, motions, takes }: Omit<Kept, 'page'>): Promise<void> => {
    const missing = <T extends { readonly id: string }>(part: Part, all: readonly T[]): T[] =>
      all.filter(({ id }) => !there[part].has(id));
    const newSongs: StoredSong[] = [];
    // Before the transaction, which does not wait for it.
    for (const { file, ...song } of missing('songs', songs))
      newSongs.push({ ...song, bytes: await file.arrayBuffer(), type: file.type });
    const newLeaders = missing('leaders', leaders);
    const newMotions = missing('motions', motions);
    const newTakes = takes.filter((take) => !alike(take, takesThere.get(take.id)));
    if ([newSongs, newLeaders, newMotions, newTakes].every(({ length }) => length === 0)) return;
    const transaction = (await open()).transaction(PARTS, 'readwrite');
    await settled([
      transaction.done,
      ...newSongs.map((song) => transaction.objectStore('songs').put(song)),
      ...newLeaders.map((leader) => transaction.objectStore('leaders').put(leader)),
      ...newMotions.map((motion) => transaction.objectStore('motions').put(motion)),
      ...newTakes.map((take) => transaction.objectStore('takes').put(take)),
    ]);
    for (const { id } of newSongs) there.songs.add(id);
    for (const { id } of newLeaders) there.leaders.add(id);
    for (const { id } of newMotions) there.motions.add(id);
    for (const take of newTakes) {
      there.takes.add(take.id);
      takesThere.set(take.id, take);
    }
  };

  return {
    read: async () => {
      const transaction = (await open()).transaction([...PARTS, 'page']);
      const [page, songs, leaders, motions, takes] = await Promise.all([
        transaction.objectStore('page').get('now'),
        transaction.objectStore('songs').getAll(),
        transaction.objectStore('leaders').getAll(),
        transaction.objectStore('motions').getAll(),
        transaction.objectStore('takes').getAll(),
        transaction.done,
      ]);
      if (!page) return null;
      there = keysOf({ songs, leaders, motions, takes });
      takesThere = new Map(takes.map((take) => [take.id, take]));
      pageThere = page;
      const files = songs.map(({ bytes, type, ...song }) => ({ ...song, file: new Blob([bytes], { type }) }));
      return { page, songs: files, leaders, motions, takes };
    },
    write: async (kept) => {
      const { songs, leaders, motions, takes, page } = kept;
      const wanted = keysOf(kept);
      await open();
      for (const part of PARTS) for (const id of wanted[part]) ours[part].add(id);
      // In a transaction of its own: a full browser gives what leaves no room to what comes in the same one.
      await remove(wanted);
      let full: unknown = null;
      const tryAdd = async (some: Partial<Kept>): Promise<void> => {
        try {
          await add({ songs: [], leaders: [], motions: [], takes: [], ...some });
        } catch (error) {
          if (!isFull(error)) throw error;
          full ??= error;
        }
      };
      const named = <T extends { readonly id: string }>(all: readonly T[], name: string | null): T[] =>
        all.filter(({ id }) => id === name);
      // Take by take, so that those that still fit are kept.
      for (const take of takes)
        await tryAdd({
          songs: named(songs, take.song),
          leaders: named(leaders, take.leader),
          motions: named(motions, take.motion),
          takes: [take],
        });
      await tryAdd({ songs: named(songs, page.song), leaders: named(leaders, page.leader) });
      const whole =
        (page.song === null || there.songs.has(page.song)) &&
        (page.leader === null || there.leaders.has(page.leader));
      if (whole) {
        await (await open()).put('page', page, 'now');
        pageThere = page;
      }
      await remove(wanted);
      if (full) throw full as DOMException;
    },
    clear: async () => {
      const transaction = (await open()).transaction([...PARTS, 'page'], 'readwrite');
      const clears = [...PARTS, 'page' as const].map((part) => transaction.objectStore(part).clear());
      await settled([transaction.done, ...clears]);
      there = noKeys();
      ours = noKeys();
      takesThere = new Map();
      pageThere = null;
    },
  };
}

/** Waits for all; the first failure is thrown, and none is left unheard. */
async function settled(all: readonly Promise<unknown>[]): Promise<void> {
  const failed = (await Promise.allSettled(all)).find((result) => result.status === 'rejected');
  if (failed) throw failed.reason;
}

function alike(take: KeptTake, other: KeptTake | undefined): boolean {
  return JSON.stringify(take) === JSON.stringify(other);
}

function keysOf(kept: Record<Part, readonly { readonly id: string }[]>): Keys {
  const ids = (part: Part): Set<string> => new Set(kept[part].map(({ id }) => id));
  return { songs: ids('songs'), leaders: ids('leaders'), motions: ids('motions'), takes: ids('takes') };
}

function noKeys(): Keys {
  return { songs: new Set(), leaders: new Set(), motions: new Set(), takes: new Set() };
}
