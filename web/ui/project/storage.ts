import {
  atOnce,
  connection,
  type Database,
  isFull,
  type Part,
  PARTS,
  recordsOf,
  type SongRecord,
  STORES,
} from './database';
import type { FoundProject } from './records';
import type { StoredLeader, StoredMotion, StoredPage, StoredProject, StoredTake } from './stored-project';

type Ids = Record<Part, Set<string>>;

/** What one transaction changes. */
interface Difference {
  readonly songs: readonly SongRecord[];
  readonly leaders: readonly StoredLeader[];
  readonly motions: readonly StoredMotion[];
  readonly takes: readonly StoredTake[];
  readonly page: StoredPage | null;
  readonly removed: readonly { readonly part: Part; readonly id: string }[];
}

const NOTHING: Difference = { songs: [], leaders: [], motions: [], takes: [], page: null, removed: [] };

/** Songs, leaders, takes and settings in the browser between two visits. */
export interface ProjectStorage {
  /** Everything that is stored, unchecked, or null when there is nothing. */
  readonly read: () => Promise<FoundProject | null>;
  /**
   * Removes what an earlier call was given and this one is not, and writes what is new or has changed, all of it or
   * nothing. Where the space is full, it writes what fits and then rejects; a stored take never loses its motion,
   * leader or song.
   */
  readonly write: (project: StoredProject) => Promise<void>;
  /** Removes all that was written in this visit or restored from an earlier one. */
  readonly removeOwn: () => Promise<void>;
  /** Removes everything. */
  readonly clear: () => Promise<void>;
}

/**
 * The page's database; its version is that of the records. Every call rejects with the browser's own error where it
 * gives no storage, as in private windows, when its space is full (`isFull`) or when a newer page has written it
 * (`isNewer`).
 */
export class ProjectDatabase implements ProjectStorage {
  private readonly open: ReturnType<typeof connection>;
  /** Ids in the database as far as this page knows. Parts never change under their id; takes do. */
  private present: Ids = noIds();
  /** Ids that this page has written. The others belong to another tab, or could not be restored in this visit. */
  private own: Ids = noIds();
  private storedTakes = new Map<string, StoredTake>();
  private storedPage: StoredPage | null = null;
  /** The database whose content is known; the browser may close it and delete what sites keep while the page is open. */
  private known: Database | null = null;
  /** The last write did not fit. */
  private isFull = false;

  constructor(name: string) {
    this.open = connection(name);
  }

  async read(): Promise<FoundProject | null> {
    const database = await this.open();
    const transaction = database.transaction(STORES);
    const [page, songs, leaders, motions, takes] = await Promise.all([
      transaction.objectStore('page').get('now'),
      transaction.objectStore('songs').getAll(),
      transaction.objectStore('leaders').getAll(),
      transaction.objectStore('motions').getAll(),
      transaction.objectStore('takes').getAll(),
      transaction.done,
    ]);
    this.present = idsOf({ songs, leaders, motions, takes });
    this.storedTakes = new Map(takes.map((take) => [take.id, take]));
    this.storedPage = page ?? null;
    this.known = database;
    return page || takes.length > 0 ? { page, songs, leaders, motions, takes } : null;
  }

  async write(project: StoredProject): Promise<void> {
    const database = await this.open();
    if (this.known && this.known !== database) await this.read();
    this.known = database;
    const wanted = idsOf(project);
    for (const part of PARTS) for (const id of wanted[part]) this.own[part].add(id);
    const songs = this.missing('songs', project.songs);
    const difference = {
      ...this.difference(project, songs.length > 0 ? await recordsOf(songs) : []),
      page: isSame(project.page, this.storedPage) ? null : project.page,
      removed: this.unused(wanted, project.takes, project.page),
    };
    // Browsers free the space of a transaction that did not fit only later, so a full storage is not tried at once.
    if (!this.isFull)
      try {
        return await this.commit(difference);
      } catch (error) {
        if (!isFull(error)) throw error;
        this.isFull = true;
      }
    await this.writeWhatFits(project, wanted);
    this.isFull = false;
  }

  async removeOwn(): Promise<void> {
    if (PARTS.every((part) => this.own[part].size === 0)) return;
    await atOnce(await this.open(), (transaction, send) => {
      for (const part of PARTS)
        for (const id of this.own[part]) send(transaction.objectStore(part).delete(id));
      send(transaction.objectStore('page').delete('now'));
    });
    for (const part of PARTS) for (const id of this.own[part]) this.present[part].delete(id);
    for (const id of this.own.takes) this.storedTakes.delete(id);
    this.own = noIds();
    this.storedPage = null;
  }

  async clear(): Promise<void> {
    await atOnce(await this.open(), (transaction, send) => {
      for (const part of STORES) send(transaction.objectStore(part).clear());
    });
    this.present = noIds();
    this.own = noIds();
    this.storedTakes = new Map();
    this.storedPage = null;
  }

  /**
   * What does not fit in one transaction, in several: what has left the page first, because a full storage frees no
   * space for what is added in the same transaction, then take by take, each with its parts, first those whose motion
   * is there, since they are small, and the page last.
   * @throws the browser's error when something did not fit
   */
  private async writeWhatFits(project: StoredProject, wanted: Ids): Promise<void> {
    const { songs, leaders, motions, takes, page } = project;
    await this.removeUnused(wanted);
    const additions = takes.map((take) => ({
      songs: withId(songs, take.song),
      leaders: withId(leaders, take.leader),
      motions: withId(motions, take.motion),
      takes: [take],
    }));
    const hasNewMotion = ({ motions }: { motions: StoredProject['motions'] }): number =>
      this.missing('motions', motions).length;
    additions.sort((a, b) => hasNewMotion(a) - hasNewMotion(b));
    const pageFiles = { songs: withId(songs, page.song), leaders: withId(leaders, page.leader) };
    let full: Error | null = null;
    for (const addition of [...additions, { ...pageFiles, motions: [], takes: [] }])
      try {
        const newSongs = await recordsOf(this.missing('songs', addition.songs));
        await this.commit(this.difference(addition, newSongs));
      } catch (error) {
        if (!isFull(error)) throw error;
        full ??= error;
      }
    const { present } = this;
    const complete =
      (page.song === null || present.songs.has(page.song)) &&
      (page.leader === null || present.leaders.has(page.leader));
    if (complete) await this.commit({ ...NOTHING, page });
    await this.removeUnused(wanted);
    if (full) throw full;
  }

  /** What the database lacks of these. */
  private difference(
    { leaders, motions, takes }: Pick<StoredProject, 'leaders' | 'motions' | 'takes'>,
    songs: readonly SongRecord[],
  ): Difference {
    return {
      ...NOTHING,
      songs,
      leaders: this.missing('leaders', leaders),
      motions: this.missing('motions', motions),
      takes: takes.filter((take) => !isSame(take, this.storedTakes.get(take.id))),
    };
  }

  private missing<T extends { readonly id: string }>(part: Part, all: readonly T[]): T[] {
    return all.filter(({ id }) => !this.present[part].has(id));
  }

  private async commit({ songs, leaders, motions, takes, page, removed }: Difference): Promise<void> {
    if (!page && [songs, leaders, motions, takes, removed].every(({ length }) => length === 0)) return;
    await atOnce(await this.open(), (transaction, send) => {
      for (const song of songs) send(transaction.objectStore('songs').put(song));
      for (const leader of leaders) send(transaction.objectStore('leaders').put(leader));
      for (const motion of motions) send(transaction.objectStore('motions').put(motion));
      for (const take of takes) send(transaction.objectStore('takes').put(take));
      if (page) send(transaction.objectStore('page').put(page, 'now'));
      for (const { part, id } of removed) send(transaction.objectStore(part).delete(id));
    });
    const added = idsOf({ songs, leaders, motions, takes });
    for (const part of PARTS) for (const id of added[part]) this.present[part].add(id);
    for (const take of takes) this.storedTakes.set(take.id, take);
    if (page) this.storedPage = page;
    for (const { part, id } of removed) {
      this.own[part].delete(id);
      this.present[part].delete(id);
      if (part === 'takes') this.storedTakes.delete(id);
    }
  }

  private async removeUnused(wanted: Ids): Promise<void> {
    const stored = [...this.storedTakes.values()].filter(({ id }) => wanted.takes.has(id));
    const removed = this.unused(wanted, stored, this.storedPage);
    await this.commit({ ...NOTHING, removed });
  }

  /**
   * This page's takes that have left it, and what neither the page nor anything in the database will refer to.
   * @param takes of this page, as they will be in the database
   */
  private unused(wanted: Ids, takes: readonly StoredTake[], page: StoredPage | null): Difference['removed'] {
    const foreign = [...this.storedTakes.values()].filter(({ id }) => !this.own.takes.has(id));
    const referred = referredIds([...foreign, ...takes], page);
    return PARTS.flatMap((part) =>
      [...this.own[part]]
        .filter((id) => !wanted[part].has(id) && !referred[part].has(id))
        .filter((id) => this.present[part].has(id))
        .map((id) => ({ part, id })),
    );
  }
}

/** Ids that takes and page refer to. */
function referredIds(takes: readonly StoredTake[], page: StoredPage | null): Ids {
  const ids = noIds();
  for (const { id, song, leader, motion } of takes) {
    ids.takes.add(id);
    ids.motions.add(motion);
    ids.leaders.add(leader);
    if (song !== null) ids.songs.add(song);
  }
  if (page?.song) ids.songs.add(page.song);
  if (page?.leader) ids.leaders.add(page.leader);
  return ids;
}

function isSame(one: unknown, other: unknown): boolean {
  return JSON.stringify(one) === JSON.stringify(other);
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
