import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Inputs, LoadedLeader, LoadedSong, Reaction, Take } from '../store/reaction';
import type { AppState } from '../store/state';
import { currentInputs } from '../store/take';
import {
  decoderOf,
  type StoredProject,
  type StoredInputs,
  type StoredLeader,
  type StoredMotion,
  type StoredSong,
  type StoredTake,
  storedInputs,
} from './schema';

/** How stored songs and leaders are read again; null for one that can't be read any more. */
export interface StoredFileReaders {
  readonly song: (song: StoredSong) => Promise<LoadedSong | null>;
  readonly leader: (leader: StoredLeader) => Promise<LoadedLeader | null>;
}

/** Turns a stored project back into state, while its songs and leaders are read one after the other. */
export class Restorer {
  /** By id, as far as they have been read; null for one that could not be read. */
  private readonly songs = new Map<string, LoadedSong | null>();
  private readonly leaders = new Map<string, LoadedLeader | null>();
  private readonly motions: ReadonlyMap<string, StoredMotion>;

  /** @param onRestored called with each part that is restored and its id */
  constructor(
    private readonly stored: StoredProject,
    private readonly onRestored: (part: object, id: string) => void = () => undefined,
  ) {
    this.motions = new Map(stored.motions.map((motion) => [motion.id, motion]));
    for (const [id, { motion }] of this.motions) onRestored(motion, id);
  }

  /** Reads the song and the leader of the page. */
  async readPage(readers: StoredFileReaders): Promise<void> {
    const { songs, leaders, page } = this.stored;
    await Promise.all([
      ...songs.filter(({ id }) => id === page.song).map((song) => this.readSong(song, readers)),
      ...leaders.filter(({ id }) => id === page.leader).map((leader) => this.readLeader(leader, readers)),
    ]);
  }

  /** Reads those that only takes refer to, and tries again what failed. */
  async readRest(readers: StoredFileReaders): Promise<void> {
    const { songs, leaders } = this.stored;
    for (const leader of leaders) if (!this.leaders.get(leader.id)) await this.readLeader(leader, readers);
    for (const song of songs) if (!this.songs.get(song.id)) await this.readSong(song, readers);
  }

  /**
   * The part of the state that has been restored so far.
   * @param state the page's, with its settings and manifest: a stored input that is missing or of another type than
   *   the page's takes the page's value, and latents of another decoder than the manifest's are left out
   */
  content(state: AppState): Partial<AppState> {
    const { page } = this.stored;
    const takes = this.takes(state);
    const leader = (page.leader !== null && this.leaders.get(page.leader)) || null;
    const song = (page.song !== null && this.songs.get(page.song)) || null;
    const onStage = takes.find(({ id }) => id === page.shown)?.reaction ?? null;
    const reaction = onStage?.inputs.leader === leader ? onStage : null;
    const other = reaction && takes.some(({ id }) => id === page.other) ? page.other : null;
    const { letter, takesMade, footLock, countings = [], time } = page;
    return {
      ...(leader && page.inputs ? restoredInputs(page.inputs, state, leader, song) : { leader, song }),
      takes,
      takesMade: Math.max(takesMade, ...takes.map(({ number }) => number)),
      reaction,
      other,
      letter,
      compare: other === null ? 'off' : page.compare,
      footLock,
      countings,
      playback: {
        ...state.playback,
        playing: false,
        time: leader ? Math.min(time, seconds(leader.motion)) : 0,
      },
    };
  }

  /** Sentences about what could not be restored. */
  losses(): string[] {
    const { leaders, songs, takes } = this.stored;
    return [
      ...leaders
        .filter(({ id }) => this.leaders.get(id) === null)
        .map(({ id, name }) => {
          const count = takes.filter((take) => take.leader === id).length;
          const lostTakes =
            count === 0 ? '' : count === 1 ? '; its take is left out' : `; its ${count} takes are left out`;
          return `The leader ${name} could not be read again${lostTakes}.`;
        }),
      ...songs
        .filter(({ id }) => this.songs.get(id) === null)
        .map(({ name }) => `The song ${name} could not be read again; its takes are there without it.`),
    ];
  }

  private async readSong(song: StoredSong, readers: StoredFileReaders): Promise<void> {
    const read = await readers.song(song);
    if (read) this.onRestored(read, song.id);
    this.songs.set(song.id, read);
  }

  private async readLeader(leader: StoredLeader, readers: StoredFileReaders): Promise<void> {
    const read = await readers.leader(leader);
    if (read) this.onRestored(read, leader.id);
    this.leaders.set(leader.id, read);
  }

  /** The takes whose leader, song and motion have been read, the newest first. */
  private takes(state: AppState): readonly Take[] {
    return this.stored.takes
      .map((take) => this.take(take, state))
      .filter((take) => take !== null)
      .toSorted((a, b) => b.createdAt - a.createdAt || b.number - a.number);
  }

  /** Null until the take's leader is there; a song that could not be read leaves it without one. */
  private take(stored: StoredTake, state: AppState): Take | null {
    const leader = this.leaders.get(stored.leader);
    const song = stored.song === null ? null : this.songs.get(stored.song);
    const made = this.motions.get(stored.motion);
    if (!leader || song === undefined || !made) return null;
    const { id, number, name, starred, createdAt, label, seconds } = stored;
    const reaction: Reaction = {
      motion: made.motion,
      latents: readableLatents(made, state),
      inputs: restoredInputs(stored.inputs, state, leader, song),
      label,
      seconds,
    };
    return { id, number, name, starred, createdAt, reaction };
  }
}

/** Latents of the loaded model's decoder; null for those of another model, which this one can't decode. */
function readableLatents({ latents }: StoredMotion, { manifest }: AppState): Float32Array | null {
  return latents && manifest && latents.decoder === decoderOf(manifest) ? latents.values : null;
}

function seconds({ frames, fps }: SolvedMotion): number {
  return frames / fps;
}

/** Stored inputs in the form that inputs have now. */
function restoredInputs(
  stored: StoredInputs,
  state: AppState,
  leader: LoadedLeader,
  song: LoadedSong | null,
): Inputs {
  // In proportion, where a height is missing.
  const settings = state.settings && { ...state.settings, height: null };
  const present = currentInputs({ ...state, leader, song, settings });
  if (!present) throw new Error('Inputs are restored once the settings are there.');
  return { ...(conform(storedInputs(present), stored) as Omit<Inputs, 'leader' | 'song'>), leader, song };
}

/** The value where it is of the example's type, part by part; the example elsewhere. */
function conform(example: unknown, value: unknown): unknown {
  if (typeof example === 'number')
    return typeof value === 'number' && Number.isFinite(value) ? value : example;
  // A number that need not be there.
  if (example === null) return typeof value === 'number' && Number.isFinite(value) ? value : null;
  if (example === null || typeof example !== 'object')
    return typeof value === typeof example ? value : example;
  if (value === null || typeof value !== 'object') return example;
  const parts = Object.entries(example).map(([key, part]) => [
    key,
    conform(part, (value as StoredInputs)[key]),
  ]);
  return Array.isArray(example) ? parts.map(([, part]) => part) : Object.fromEntries(parts);
}
