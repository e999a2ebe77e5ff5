import {
  type DBSchema,
  type IDBPDatabase,
  type IDBPObjectStore,
  openDB,
  type OpenDBCallbacks,
  type StoreNames,
} from 'idb';
import type { StoredProject, StoredLeader, StoredMotion, StoredPage, StoredSong, StoredTake } from './schema';

/** A song in the database: its bytes, because not every browser can store blobs in private windows. */
interface SongRecord extends Omit<StoredSong, 'file'> {
  readonly bytes: ArrayBuffer;
  readonly type: string;
}

interface Schema extends DBSchema {
  songs: { key: string; value: SongRecord };
  leaders: { key: string; value: StoredLeader };
  motions: { key: string; value: StoredMotion };
  takes: { key: string; value: StoredTake };
  page: { key: 'now'; value: StoredPage };
}

const PARTS = ['songs', 'leaders', 'motions', 'takes'] as const;
type Part = (typeof PARTS)[number];
type Ids = Record<Part, Set<string>>;
/** Parts to add to the database: all that are given, or none. */
type Addition = Omit<StoredProject, 'page'>;

/** Songs, leaders, takes and settings in the browser between two visits. */
export interface ProjectStorage {
  /** Everything that is stored, or null when there is nothing. */
  readonly read: () => Promise<StoredProject | null>;
  /**
   * Removes what an earlier call was given and this one is not, and writes what is new or has changed. Where the space
   * is full, it writes what fits and then rejects; a stored take never loses its motion, leader or song.
   */
  readonly write: (project: StoredProject) => Promise<void>;
  readonly clear: () => Promise<void>;
}

/** Whether the browser has no more space for the page. */
export function isFull(error: unknown): error is DOMException {
  return error instanceof DOMException && error.name === 'QuotaExceededError';
}

/**
 * The page's database. Every call rejects with the browser's own error where it gives no storage, as in private
 * windows, or when its space is full (`isFull`).
 */
export class ProjectDatabase implements ProjectStorage {
  private readonly open: () => Promise<IDBPDatabase<Schema>>;
  /** Ids in the database as far as this page knows. Parts never change under their id; takes do. */
  private present: Ids = noIds();
  /** Ids that this page has written. The others belong to another tab, or could not be restored in this visit. */
  private own: Ids = noIds();
  private storedTakes = new Map<string, StoredTake>();
  private storedPage: StoredPage | null = null;

  constructor(name = 'reactdance') {
    this.open = connection(name);
  }

  async read(): Promise<StoredProject | null> {
    const transaction = (await this.open()).transaction([...PARTS, 'page']);
    const [page, songs, leaders, motions, takes] = await Promise.all([
      transaction.objectStore('page').get('now'),
      transaction.objectStore('songs').getAll(),
      transaction.objectStore('leaders').getAll(),
      transaction.objectStore('motions').getAll(),
      transaction.objectStore('takes').getAll(),
      transaction.done,
    ]);
    if (!page) return null;
    this.present = idsOf({ songs, leaders, motions, takes });
    this.storedTakes = new Map(takes.map((take) => [take.id, take]));
    this.storedPage = page;
    const files = songs.map(({ bytes, type, ...song }) => ({ ...song, file: new Blob([bytes], { type }) }));
    return { page, songs: files, leaders, motions, takes };
  }

  async write(project: StoredProject): Promise<void> {
    const wanted = idsOf(project);
    await this.open();
    for (const part of PARTS) for (const id of wanted[part]) this.own[part].add(id);
    // In a transaction of its own: a full storage frees no space for what is added in the same one.
    await this.remove(wanted);
    const full = await this.addWhatFits(project);
    await this.writePage(project.page);
    await this.remove(wanted);
    if (full) throw full;
  }

  async clear(): Promise<void> {
    const transaction = (await this.open()).transaction([...PARTS, 'page'], 'readwrite');
    const clears = [...PARTS, 'page' as const].map((part) => transaction.objectStore(part).clear());
    await settled([transaction.done, ...clears]);
    this.present = noIds();
    this.own = noIds();
    this.storedTakes = new Map();
    this.storedPage = null;
  }

  /**
   * Adds take by take, each with its parts, so that those that still fit are stored, and the page's files last.
   * @returns the browser's error when something did not fit
   */
  private async addWhatFits({ songs, leaders, motions, takes, page }: StoredProject): Promise<Error | null> {
    const additions: Addition[] = takes.map((take) => ({
      songs: withId(songs, take.song),
      leaders: withId(leaders, take.leader),
      motions: withId(motions, take.motion),
      takes: [take],
    }));
    const pageFiles = { songs: withId(songs, page.song), leaders: withId(leaders, page.leader) };
    additions.push({ ...pageFiles, motions: [], takes: [] });
    let full: Error | null = null;
    for (const addition of additions)
      try {
        await this.add(addition);
      } catch (error) {
        if (!isFull(error)) throw error;
        full ??= error;
      }
    return full;
  }

  /** Writes what the database lacks of these, all of it or nothing. */
  private async add({ songs, leaders, motions, takes }: Addition): Promise<void> {
    const newSongs: SongRecord[] = [];
    // Before the transaction, which does not wait for it.
    for (const { file, ...song } of this.missing('songs', songs))
      newSongs.push({ ...song, bytes: await file.arrayBuffer(), type: file.type });
    const newLeaders = this.missing('leaders', leaders);
    const newMotions = this.missing('motions', motions);
    const newTakes = takes.filter((take) => !isSameTake(take, this.storedTakes.get(take.id)));
    if ([newSongs, newLeaders, newMotions, newTakes].every(({ length }) => length === 0)) return;
    const transaction = (await this.open()).transaction(PARTS, 'readwrite');
    await settled([
      transaction.done,
      ...newSongs.map((song) => transaction.objectStore('songs').put(song)),
      ...newLeaders.map((leader) => transaction.objectStore('leaders').put(leader)),
      ...newMotions.map((motion) => transaction.objectStore('motions').put(motion)),
      ...newTakes.map((take) => transaction.objectStore('takes').put(take)),
    ]);
    const added = idsOf({ songs: newSongs, leaders: newLeaders, motions: newMotions, takes: newTakes });
    for (const part of PARTS) for (const id of added[part]) this.present[part].add(id);
    for (const take of newTakes) this.storedTakes.set(take.id, take);
  }

  private missing<T extends { readonly id: string }>(part: Part, all: readonly T[]): T[] {
    return all.filter(({ id }) => !this.present[part].has(id));
  }

  /** Writes the page unless its song or its leader did not fit. */
  private async writePage(page: StoredPage): Promise<void> {
    const { songs, leaders } = this.present;
    const complete =
      (page.song === null || songs.has(page.song)) && (page.leader === null || leaders.has(page.leader));
    if (!complete) return;
    await (await this.open()).put('page', page, 'now');
    this.storedPage = page;
  }

  /** Removes takes that have left the page, and then what nothing in the database refers to any more. */
  private async remove(wanted: Ids): Promise<void> {
    for (const id of this.own.takes) if (!wanted.takes.has(id)) this.storedTakes.delete(id);
    const referred = this.referredIds();
    const unused = PARTS.flatMap((part) =>
      [...this.own[part]]
        .filter((id) => !wanted[part].has(id) && !referred[part].has(id))
        .map((id) => ({ part, id })),
    );
    if (unused.length === 0) return;
    const transaction = (await this.open()).transaction(PARTS, 'readwrite');
    await settled([
      transaction.done,
      ...unused.map(({ part, id }) => transaction.objectStore(part).delete(id)),
    ]);
    for (const { part, id } of unused) {
      this.own[part].delete(id);
      this.present[part].delete(id);
    }
  }

  /** Ids that takes and page in the database refer to; they may differ from what the page is about to write. */
  private referredIds(): Ids {
    const ids = noIds();
    for (const { id, song, leader, motion } of this.storedTakes.values()) {
      ids.takes.add(id);
      ids.motions.add(motion);
      ids.leaders.add(leader);
      if (song !== null) ids.songs.add(song);
    }
    if (this.storedPage?.song) ids.songs.add(this.storedPage.song);
    if (this.storedPage?.leader) ids.leaders.add(this.storedPage.leader);
    return ids;
  }
}

/** Opens the database once, and again after it was closed. */
function connection(name: string): () => Promise<IDBPDatabase<Schema>> {
  let opening: Promise<IDBPDatabase<Schema>> | null = null;
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
    opening ??= openDB<Schema>(name, 2, options).catch((error: unknown) => {
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

/** Waits for all; throws the first failure, and leaves no rejection unhandled. */
async function settled(all: readonly Promise<unknown>[]): Promise<void> {
  const failed = (await Promise.allSettled(all)).find((result) => result.status === 'rejected');
  if (failed) throw failed.reason;
}

function isSameTake(take: StoredTake, other: StoredTake | undefined): boolean {
  return JSON.stringify(take) === JSON.stringify(other);
}

function withId<T extends { readonly id: string }>(all: readonly T[], wanted: string | null): T[] {
  return all.filter(({ id }) => id === wanted);
}

function idsOf(parts: Record<Part, readonly { readonly id: string }[]>): Ids {
  const ids = (part: Part): Set<string> => new Set(parts[part].map(({ id }) => id));
  return { songs: ids('songs'), leaders: ids('leaders'), motions: ids('motions'), takes: ids('takes') };
}

function noIds(): Ids {
  return { songs: new Set(), leaders: new Set(), motions: new Set(), takes: new Set() };
}
