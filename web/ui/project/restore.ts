import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { AppState, Inputs, LoadedLeader, LoadedSong, Take } from '../store/state';
import { presentInputs } from '../store/take';
import {
  decoderOf,
  type Kept,
  type KeptInputs,
  type KeptLeader,
  type KeptSong,
  type KeptTake,
  otherInputs,
} from './schema';

/** How songs and leaders are read again; null for one that can't be read any more. */
export interface Rereaders {
  readonly song: (song: KeptSong) => Promise<LoadedSong | null>;
  readonly leader: (leader: KeptLeader) => Promise<LoadedLeader | null>;
}

/** Kept data whose songs and leaders come back one after the other. */
export interface Revival {
  /** Reads the song and the leader of the page. */
  readonly readPage: (readers: Rereaders) => Promise<void>;
  /** Reads those that only takes speak of, and tries again what failed. */
  readonly readRest: (readers: Rereaders) => Promise<void>;
  /**
   * What has come back so far, for the page.
   * @param state the page's, with its settings: it shows what inputs look like, so that a value that is missing or of
   *   another kind than today's is the page's own, and which model is there to read latents
   */
  readonly content: (state: AppState) => Partial<AppState>;
  /** Sentences about what could not be brought back. */
  readonly losses: () => string[];
}

/** @param known hears of each part that comes back under which id it was kept */
export function reviving(kept: Kept, known: (part: object, id: string) => void = () => undefined): Revival {
  const songs = new Map<string, LoadedSong | null>();
  const leaders = new Map<string, LoadedLeader | null>();
  const motions = new Map(kept.motions.map((motion) => [motion.id, motion]));
  for (const [id, { motion }] of motions) known(motion, id);
  const { page } = kept;

  const readSong = async (song: KeptSong, readers: Rereaders): Promise<void> => {
    const read = await readers.song(song);
    if (read) known(read, song.id);
    songs.set(song.id, read);
  };
  const readLeader = async (leader: KeptLeader, readers: Rereaders): Promise<void> => {
    const read = await readers.leader(leader);
    if (read) known(read, leader.id);
    leaders.set(leader.id, read);
  };
  /** A take becomes one again when its leader is there; a song that is lost leaves it without a song. */
  const reviveTake = (take: KeptTake, state: AppState): Take | null => {
    const leader = leaders.get(take.leader);
    const song = take.song === null ? null : songs.get(take.song);
    const made = motions.get(take.motion);
    if (!leader || song === undefined || !made) return null;
    const { id, number, name, starred, createdAt, label, seconds } = take;
    const inputs = likeToday(take.inputs, state, leader, song);
    // Another model may be here by now, to which the latents mean nothing.
    const readable = state.manifest && made.latents?.decoder === decoderOf(state.manifest);
    const latents = (readable && made.latents?.values) || null;
    const reaction = { motion: made.motion, latents, inputs, label, seconds };
    return { id, number, name, starred, createdAt, reaction };
  };

  return {
    readPage: async (readers) => {
      await Promise.all([
        ...kept.songs.filter(({ id }) => id === page.song).map((song) => readSong(song, readers)),
        ...kept.leaders.filter(({ id }) => id === page.leader).map((leader) => readLeader(leader, readers)),
      ]);
    },
    readRest: async (readers) => {
      for (const leader of kept.leaders) if (!leaders.get(leader.id)) await readLeader(leader, readers);
      for (const song of kept.songs) if (!songs.get(song.id)) await readSong(song, readers);
    },
    content: (state) => {
      const takes = kept.takes
        .map((take) => reviveTake(take, state))
        .filter((take) => take !== null)
        .toSorted((a, b) => b.createdAt - a.createdAt || b.number - a.number);
      const leader = (page.leader !== null && leaders.get(page.leader)) || null;
      const song = (page.song !== null && songs.get(page.song)) || null;
      const onStage = takes.find(({ id }) => id === page.shown)?.reaction ?? null;
      const reaction = onStage?.inputs.leader === leader ? onStage : null;
      const other = reaction && takes.some(({ id }) => id === page.other) ? page.other : null;
      const { letter, takesMade, footLock, time } = page;
      return {
        ...(leader && page.inputs ? likeToday(page.inputs, state, leader, song) : { leader, song }),
        takes,
        takesMade: Math.max(takesMade, ...takes.map(({ number }) => number)),
        reaction,
        other,
        letter,
        compare: other === null ? 'off' : page.compare,
        footLock,
        playback: {
          ...state.playback,
          playing: false,
          time: leader ? Math.min(time, lengthOf(leader.motion)) : 0,
        },
      };
    },
    losses: () => [
      ...kept.leaders
        .filter(({ id }) => leaders.get(id) === null)
        .map(({ id, name }) => {
          const count = kept.takes.filter((take) => take.leader === id).length;
          const along =
            count === 0 ? '' : count === 1 ? '; its take is left out' : `; its ${count} takes are left out`;
          return `The leader ${name} could not be read again${along}.`;
        }),
      ...kept.songs
        .filter(({ id }) => songs.get(id) === null)
        .map(({ name }) => `The song ${name} could not be read again; its takes are there without it.`),
    ],
  };
}

function lengthOf({ frames, fps }: SolvedMotion): number {
  return frames / fps;
}

/** Kept inputs in the form that inputs have now. */
function likeToday(kept: KeptInputs, state: AppState, leader: LoadedLeader, song: LoadedSong | null): Inputs {
  const today = presentInputs({ ...state, leader, song });
  if (!today) throw new Error('Inputs are revived when the settings are there.');
  return { ...(alike(otherInputs(today), kept) as Omit<Inputs, 'leader' | 'song'>), leader, song };
}

/** The value where it is of the example's kind, part by part; the example elsewhere. */
function alike(example: unknown, value: unknown): unknown {
  if (typeof example === 'number')
    return typeof value === 'number' && Number.isFinite(value) ? value : example;
  if (example === null || typeof example !== 'object')
    return typeof value === typeof example ? value : example;
  if (value === null || typeof value !== 'object') return example;
  const parts = Object.entries(example).map(([key, part]) => [key, alike(part, (value as KeptInputs)[key])]);
  return Array.isArray(example) ? parts.map(([, part]) => part) : Object.fromEntries(parts);
}
