import type { Inputs, LoadedLeader, LoadedSong, Reaction, Take } from '../store/reaction';
import type { AppState, Restoring } from '../store/state';
import { counted } from '../store/format';
import { danceDuration } from '../store/selectors';
import { newestFirst, takeTitle } from '../store/take';
import { restoredInputs } from './inputs';
import {
  decoderOf,
  type LoadedParts,
  type StoredProject,
  type StoredLeader,
  type StoredMotion,
  type StoredSong,
  type StoredTake,
} from './stored-project';

/** How stored songs and leaders are read again; null for one that can't be read any more. */
export interface StoredFileReaders {
  readonly song: (song: StoredSong) => Promise<LoadedSong | null>;
  readonly leader: (leader: StoredLeader) => Promise<LoadedLeader | null>;
}

/** What can be said of a stored project before its songs and leaders are read. */
export function restoringOf({ songs, leaders, takes, page }: StoredProject): Restoring {
  const name = (all: readonly (StoredSong | StoredLeader)[], id: string | null): string[] =>
    all.filter((part) => part.id === id).map((part) => part.name);
  return {
    what: [
      ...name(songs, page.song),
      ...name(leaders, page.leader),
      ...(takes.length > 0 ? [counted(takes.length, 'take')] : []),
    ].join(', '),
    takes: takes.toSorted(newestFirst).map(({ id, number, name, label }) => ({
      id,
      title: takeTitle({ number, name, reaction: { label } }),
    })),
  };
}

/** Turns a stored project back into state, while its songs and leaders are read one after the other. */
export class Restorer {
  /** By id, as far as they have been read; null for one that could not be read. */
  private readonly songs: Map<string, LoadedSong | null>;
  private readonly leaders: Map<string, LoadedLeader | null>;
  private readonly motions: ReadonlyMap<string, StoredMotion>;
  /** Ids of takes whose settings were beyond what the model takes. */
  private readonly changed = new Set<string>();

  /**
   * @param onRestored called with each part that is restored and its id
   * @param loaded parts that the page has already, which are not read again
   */
  constructor(
    readonly stored: StoredProject,
    private readonly onRestored: (part: object, id: string) => void = () => undefined,
    loaded: LoadedParts = { songs: new Map(), leaders: new Map() },
  ) {
    this.songs = new Map(loaded.songs);
    this.leaders = new Map(loaded.leaders);
    this.motions = new Map(stored.motions.map((motion) => [motion.id, motion]));
    for (const [id, { motion }] of this.motions) onRestored(motion, id);
  }

  /** Reads the leader of the page; with it, and without its song, the page can be shown. */
  async readPageLeader(readers: StoredFileReaders): Promise<void> {
    const { leaders, page } = this.stored;
    for (const leader of leaders) if (leader.id === page.leader) await this.readLeader(leader, readers);
  }

  async readPageSong(readers: StoredFileReaders): Promise<void> {
    const { songs, page } = this.stored;
    for (const song of songs) if (song.id === page.song) await this.readSong(song, readers);
  }

  /** Reads those that only takes refer to, and tries again what failed. */
  async readRest(readers: StoredFileReaders): Promise<void> {
    const { songs, leaders } = this.stored;
    for (const leader of leaders) if (!this.leaders.get(leader.id)) await this.readLeader(leader, readers);
    for (const song of songs) if (!this.songs.get(song.id)) await this.readSong(song, readers);
  }

  /** The song of the page and the ids of its takes; null while it is not read. */
  pageSong(): { readonly song: LoadedSong; readonly takes: ReadonlySet<string> } | null {
    const { page, takes } = this.stored;
    const song = page.song === null ? null : this.songs.get(page.song);
    if (!song) return null;
    return { song, takes: new Set(takes.filter((take) => take.song === page.song).map(({ id }) => id)) };
  }

  /**
   * The part of the state that has been restored so far.
   * @param state the page's, with its settings and manifest, see `restoredInputs`; latents of another decoder than the
   *   manifest's are left out
   */
  content(state: AppState): Partial<AppState> {
    const { page } = this.stored;
    const takes = this.takes(state);
    const leader = (page.leader !== null && this.leaders.get(page.leader)) || null;
    const song = this.pageSong()?.song ?? null;
    const onStage = takes.find(({ id }) => id === page.shown)?.reaction ?? null;
    const reaction = onStage?.inputs.leader === leader ? onStage : null;
    const other = reaction && takes.some(({ id }) => id === page.other) ? page.other : null;
    const { letter, takesMade, footLock, countings, time, region, loop, framing } = page;
    // Without a leader the song sets the length, also while it is still being read.
    const isKnown = leader !== null || song !== null || page.song === null;
    const length = isKnown ? danceDuration({ leader, song }) : Infinity;
    const inputs: Partial<Inputs> =
      leader && page.inputs ? restoredInputs(page.inputs, state, leader, song).inputs : { song, shift: 0 };
    return {
      ...inputs,
      leader,
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
        time: Math.min(time, length),
        region: region && region.to <= length ? region : null,
        loop,
      },
      ...(framing && { camera: framing.view }),
    };
  }

  /**
   * The takes whose leader, song and motion have been read, the newest first; those of the page's song are there before
   * it, without a song.
   */
  takes(state: AppState): readonly Take[] {
    return this.stored.takes
      .map((take) => this.take(take, state))
      .filter((take) => take !== null)
      .toSorted(newestFirst);
  }

  /** Sentences about what could not be restored. */
  losses(): string[] {
    const { leaders, songs, takes } = this.stored;
    const shorter = takes.filter((take) => this.isOfOtherLength(take)).length;
    const changed = this.changed.size;
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
      ...(shorter > 0
        ? [
            shorter === 1
              ? 'A take of another length than the leader is left out.'
              : `${shorter} takes of another length than their leader are left out.`,
          ]
        : []),
      ...(changed > 0
        ? [
            `The settings of ${changed === 1 ? 'a take' : `${changed} takes`} are outside this model’s range; the ` +
              'nearest are shown.',
          ]
        : []),
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

  /** Null until the take's leader is there; a song that could not be read leaves it without one. */
  private take(stored: StoredTake, state: AppState): Take | null {
    const leader = this.leaders.get(stored.leader);
    const song = stored.song === null ? null : this.songs.get(stored.song);
    const isComing = song === undefined && stored.song !== this.stored.page.song;
    const made = this.motions.get(stored.motion);
    if (!leader || isComing || !made || this.isOfOtherLength(stored)) return null;
    const { id, number, name, starred, createdAt, label, seconds, model, unfamiliarity } = stored;
    const { inputs, changed } = restoredInputs(stored.inputs, state, leader, song ?? null);
    if (changed) this.changed.add(id);
    const { motion } = made;
    const latents = readableLatents(made, state);
    const reaction: Reaction = { motion, latents, model, inputs, unfamiliarity, label, seconds };
    return { id, number, name, starred, createdAt, reaction };
  }

  /** Whether a take's motion does not last as long as its leader, as far as that is read. */
  private isOfOtherLength({ leader, motion }: StoredTake): boolean {
    const [led, made] = [this.leaders.get(leader)?.motion, this.motions.get(motion)?.motion];
    return led !== undefined && made !== undefined && (led.frames !== made.frames || led.fps !== made.fps);
  }
}

/** Latents of the loaded model's decoder; null for those of another model or length, which it can't decode. */
function readableLatents({ motion, latents }: StoredMotion, { manifest }: AppState): Float32Array | null {
  if (!latents || !manifest || latents.decoder !== decoderOf(manifest)) return null;
  const { stride, layers, channels } = manifest.latent;
  const length = Math.ceil(motion.frames / stride) * layers.length * channels;
  return latents.values.length === length ? latents.values : null;
}
