import { type DBSchema, type IDBPDatabase, openDB } from 'idb';
import type { Kept, KeptLeader, KeptMotion, KeptPage, KeptSong, KeptTake } from './kept';

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
  /** Writes what is new or has changed and removes what an earlier call was given and this one is not. */
  readonly write: (kept: Kept) => Promise<void>;
  readonly clear: () => Promise<void>;
}

/**
 * The page's database. Every call rejects with the browser's own error where it gives no storage, as in private
 * windows, or when its disk is full; nothing is half written then.
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
  let takesThere = new Map<string, string>();

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
      there = {
        songs: idsOf(songs),
        leaders: idsOf(leaders),
        motions: idsOf(motions),
        takes: idsOf(takes),
      };
      takesThere = new Map(takes.map((take) => [take.id, JSON.stringify(take)]));
      const files = songs.map(({ bytes, type, ...song }) => ({ ...song, file: new Blob([bytes], { type }) }));
      return { page, songs: files, leaders, motions, takes };
    },
    write: async (kept) => {
      const songs: StoredSong[] = [];
      for (const { file, ...song } of kept.songs)
        if (!there.songs.has(song.id))
          songs.push({ ...song, bytes: await file.arrayBuffer(), type: file.type });
      const transaction = (await open()).transaction([...PARTS, 'page'], 'readwrite');
      const writes: Promise<unknown>[] = songs.map((song) => transaction.objectStore('songs').put(song));
      for (const leader of kept.leaders)
        if (!there.leaders.has(leader.id)) writes.push(transaction.objectStore('leaders').put(leader));
      for (const motion of kept.motions)
        if (!there.motions.has(motion.id)) writes.push(transaction.objectStore('motions').put(motion));
      const takes = new Map(kept.takes.map((take) => [take.id, JSON.stringify(take)]));
      for (const take of kept.takes)
        if (takesThere.get(take.id) !== takes.get(take.id))
          writes.push(transaction.objectStore('takes').put(take));
      const wanted: Keys = {
        songs: idsOf(kept.songs),
        leaders: idsOf(kept.leaders),
        motions: idsOf(kept.motions),
        takes: idsOf(kept.takes),
      };
      for (const part of PARTS)
        for (const id of ours[part])
          if (!wanted[part].has(id)) writes.push(transaction.objectStore(part).delete(id));
      writes.push(transaction.objectStore('page').put(kept.page, 'now'));
      await settled([transaction.done, ...writes]);
      for (const part of PARTS) {
        for (const id of ours[part]) there[part].delete(id);
        for (const id of wanted[part]) there[part].add(id);
      }
      ours = wanted;
      takesThere = takes;
    },
    clear: async () => {
      const transaction = (await open()).transaction([...PARTS, 'page'], 'readwrite');
      const clears = [...PARTS, 'page' as const].map((part) => transaction.objectStore(part).clear());
      await settled([transaction.done, ...clears]);
      there = noKeys();
      ours = noKeys();
      takesThere = new Map();
    },
  };
}

/** Waits for all; the first failure is thrown, and none is left unheard. */
async function settled(all: readonly Promise<unknown>[]): Promise<void> {
  const failed = (await Promise.allSettled(all)).find((result) => result.status === 'rejected');
  if (failed) throw failed.reason;
}

function idsOf(parts: readonly { readonly id: string }[]): Set<string> {
  return new Set(parts.map(({ id }) => id));
}

function noKeys(): Keys {
  return { songs: new Set(), leaders: new Set(), motions: new Set(), takes: new Set() };
}
