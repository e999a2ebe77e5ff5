/** The page's IndexedDB database: its stores, its upgrades, and changes that are made whole or not at all. */
import {
  type DBSchema,
  type IDBPDatabase,
  type IDBPObjectStore,
  type IDBPTransaction,
  openDB,
  type OpenDBCallbacks,
  type StoreNames,
} from 'idb';
import {
  type StoredLeader,
  type StoredMotion,
  type StoredPage,
  type StoredSong,
  type StoredTake,
  VERSION,
} from './stored-project';

/** A song in the database: its bytes, because not every browser can store blobs in private windows. */
export interface SongRecord extends Omit<StoredSong, 'file'> {
  readonly bytes: ArrayBuffer;
  readonly type: string;
}

export async function recordsOf(songs: readonly StoredSong[]): Promise<SongRecord[]> {
  return Promise.all(
    songs.map(async ({ file, ...song }) => ({ ...song, bytes: await file.arrayBuffer(), type: file.type })),
  );
}

interface Schema extends DBSchema {
  songs: { key: string; value: SongRecord };
  leaders: { key: string; value: StoredLeader };
  motions: { key: string; value: StoredMotion };
  takes: { key: string; value: StoredTake };
  page: { key: 'now'; value: StoredPage };
}

export type Database = IDBPDatabase<Schema>;

export const PARTS = ['songs', 'leaders', 'motions', 'takes'] as const;
export const STORES = [...PARTS, 'page'] as const;
export type Part = (typeof PARTS)[number];

/** Whether the browser has no more space for the page. */
export function isFull(error: unknown): error is DOMException {
  return error instanceof DOMException && error.name === 'QuotaExceededError';
}

/** Whether what is stored was written by a newer version of the page, which this one leaves alone. */
export function isNewer(error: unknown): error is DOMException {
  return error instanceof DOMException && error.name === 'VersionError';
}

/**
 * Makes all of a change or nothing, in one transaction. Its requests and its commit are sent in the same task: a page
 * that is reloaded or ends the next moment is sure of what was committed, and of nothing else.
 */
export async function atOnce(
  database: Database,
  request: (
    transaction: IDBPTransaction<Schema, typeof STORES, 'readwrite'>,
    send: (request: Promise<unknown>) => void,
  ) => void,
): Promise<void> {
  const transaction = database.transaction(STORES, 'readwrite');
  // A full storage also aborts the requests beside the one that did not fit. They are not waited for: Chromium may end
  // the transaction and leave some without an answer.
  const failures: unknown[] = [];
  try {
    request(transaction, (one) => void one.catch((error: unknown) => failures.push(error)));
    transaction.commit();
  } catch (error) {
    // Else what was sent before would be kept.
    transaction.abort();
    await transaction.done.catch(() => undefined);
    throw error;
  }
  try {
    await transaction.done;
  } catch (error) {
    throw failures.find(isFull) ?? error;
  }
}

/** Opens the database once, and again after it was closed. */
export function connection(name: string): () => Promise<Database> {
  let opening: Promise<Database> | null = null;
  const reset = (): void => {
    opening = null;
  };
  const options: OpenDBCallbacks<Schema> = {
    upgrade: (database, oldVersion, _newVersion, transaction) => {
      if (oldVersion > 0) return void convertLeaders(transaction.objectStore('leaders'));
      for (const part of PARTS) database.createObjectStore(part, { keyPath: 'id' });
      database.createObjectStore('page');
    },
    // Another tab has a newer page: it may go ahead, this one opens the database again when it needs it.
    blocking: (_now, _wanted, event) => {
      (event.target as IDBDatabase).close();
      reset();
    },
    terminated: reset,
  };
  return () => {
    opening ??= openDB<Schema>(name, VERSION, options).catch((error: unknown) => {
      reset();
      throw error;
    });
    return opening;
  };
}

/** A leader as the first version stored it: the text of a BVH file, and its frame rate where that was set by hand. */
type FirstLeader = Pick<StoredLeader, 'id' | 'name' | 'label'> & { text: string; fps: number | null };

/** Converts leaders of the first version, within the transaction that upgrades the database. */
async function convertLeaders(
  leaders: IDBPObjectStore<Schema, StoreNames<Schema>[], 'leaders', 'versionchange'>,
): Promise<void> {
  for (const first of (await leaders.getAll()) as unknown as FirstLeader[]) {
    const { id, name, label, text, fps } = first;
    const files = [{ name, bytes: new TextEncoder().encode(text) }];
    await leaders.put({ id, name, label, files, options: fps === null ? {} : { fps } });
  }
}
