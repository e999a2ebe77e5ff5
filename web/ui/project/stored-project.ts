import type { Framing } from '../../common/framing';
import { hex } from '../../common/sha256';
import type { Manifest } from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type {
  Inputs,
  LeaderSource,
  LoadedLeader,
  LoadedSong,
  ModelIdentity,
  Reaction,
} from '../store/reaction';
import { isOf } from '../store/counting';
import type { AppState, Compare, Letter, SongCounting } from '../store/state';
import { currentInputs, takeOnStage } from '../store/take';
import type { Span } from '../store/time-scale';

/**
 * Version of the records, in the database and in project files. Raised when pages of the version before can't read
 * them any more, or would leave out something of the visitor's work when they write them again.
 */
export const VERSION = 2;

/** A song: the file that it was read from. */
export interface StoredSong {
  readonly id: string;
  readonly name: string;
  readonly label: string | null;
  readonly file: Blob;
}

export interface StoredLeader extends LeaderSource {
  readonly id: string;
}

export interface StoredMotion {
  readonly id: string;
  readonly motion: SolvedMotion;
  /** Left out where the motion came ready-made, or was stored by a page that did not store latents. */
  readonly latents?: StoredLatents | undefined;
}

/** What a motion was decoded from, as in `Reaction`. */
interface StoredLatents {
  /** The decoder they are for, as `decoderOf` names it. */
  readonly decoder: string;
  readonly values: Float32Array;
}

/** Identifies a model's decoder: the SHA-256 of its graph. */
export function decoderOf({ graphs }: Manifest): string {
  return graphs.decode.files.wasm.sha256;
}

/** What a reaction is made from besides song and leader: settings, and whatever else `Inputs` has. */
export type StoredInputs = Readonly<Record<string, unknown>>;

export interface StoredTake {
  readonly id: string;
  readonly number: number;
  readonly name: string | null;
  readonly starred: boolean;
  readonly createdAt: number;
  readonly label: string | null;
  readonly seconds: number | null;
  readonly model?: ModelIdentity | undefined;
  readonly unfamiliarity?: number | undefined;
  /** Ids of the parts. */
  readonly motion: string;
  readonly leader: string;
  readonly song: string | null;
  readonly inputs: StoredInputs;
}

/** What is on the page, by ids. */
export interface StoredPage {
  readonly leader: string | null;
  readonly song: string | null;
  /** Null while there was no leader. */
  readonly inputs: StoredInputs | null;
  readonly shown: string | null;
  readonly other: string | null;
  readonly letter: Letter;
  readonly compare: Compare;
  readonly takesMade: number;
  readonly footLock: boolean;
  readonly countings: readonly SongCounting[];
  /** Seconds. */
  readonly time: number;
  /** The chosen part of the dance. */
  readonly region: Span | null;
  /** Whether that part, or the whole dance, repeats. */
  readonly loop: boolean;
  /** How the camera sees the couple; null where the page shows none. */
  readonly framing: Framing | null;
}

/** What storage and project files hold: plain data from which songs and leaders are read and analysed again. */
export interface StoredProject {
  readonly songs: readonly StoredSong[];
  readonly leaders: readonly StoredLeader[];
  readonly motions: readonly StoredMotion[];
  readonly takes: readonly StoredTake[];
  readonly page: StoredPage;
}

/** Ids of songs, leaders and motions; the same object has the same id until the page is closed. */
const ids = new WeakMap<object, string>();

function idOf(part: object): string {
  let id = ids.get(part);
  if (id === undefined) {
    id = hex(crypto.getRandomValues(new Uint8Array(8)));
    ids.set(part, id);
  }
  return id;
}

/** Gives a restored object the id under which it is stored already. */
export function assignId(part: object, id: string): void {
  ids.set(part, id);
}

/** Songs and leaders by the ids under which they are stored. */
export interface LoadedParts {
  readonly songs: ReadonlyMap<string, LoadedSong>;
  readonly leaders: ReadonlyMap<string, LoadedLeader>;
}

/** Those on the page and those of its takes. */
export function loadedParts({ takes, song, leader }: AppState): LoadedParts {
  const songs = new Map<string, LoadedSong>();
  const leaders = new Map<string, LoadedLeader>();
  for (const parts of [{ song, leader }, ...takes.map(({ reaction }) => reaction.inputs)]) {
    if (parts.song) songs.set(idOf(parts.song), parts.song);
    if (parts.leader) leaders.set(idOf(parts.leader), parts.leader);
  }
  return { songs, leaders };
}

/**
 * The part of the state that is stored, with songs, leaders and motions referred to by id.
 * @param framing the stage's
 */
export function storedProject(state: AppState, framing: Framing | null = null): StoredProject {
  const songs = new Map<string, StoredSong>();
  const leaders = new Map<string, StoredLeader>();
  const motions = new Map<string, StoredMotion>();
  const song = (part: LoadedSong | null): string | null => {
    if (!part) return null;
    const { name, label, file } = part;
    const id = idOf(part);
    songs.set(id, { id, name, label, file });
    return id;
  };
  const leader = (part: LoadedLeader): string => {
    const { name, label, files, options } = part;
    const id = idOf(part);
    leaders.set(id, { id, name, label, files, options });
    return id;
  };
  const motion = ({ motion: part, latents: values }: Reaction): string => {
    const id = idOf(part);
    const latents = values && state.manifest && { decoder: decoderOf(state.manifest), values };
    motions.set(id, { id, motion: part, ...(latents && { latents }) });
    return id;
  };

  const takes = state.takes.map(({ id, number, name, starred, createdAt, reaction }): StoredTake => {
    const { label, seconds, model, unfamiliarity, inputs } = reaction;
    const parts = {
      motion: motion(reaction),
      leader: leader(inputs.leader),
      song: song(inputs.song),
      inputs: storedInputs(inputs),
    };
    return { id, number, name, starred, createdAt, label, seconds, model, unfamiliarity, ...parts };
  });
  const inputs = currentInputs(state);
  const { other, letter, compare, takesMade, footLock, countings, playback } = state;
  const page: StoredPage = {
    leader: state.leader ? leader(state.leader) : null,
    song: song(state.song),
    inputs: inputs ? storedInputs(inputs) : null,
    shown: takeOnStage(state)?.id ?? null,
    other,
    letter,
    compare,
    takesMade,
    footLock,
    countings,
    time: playback.time,
    region: playback.region,
    loop: playback.loop,
    framing: state.leader && framing,
  };
  return {
    songs: [...songs.values()],
    leaders: [...leaders.values()],
    motions: [...motions.values()],
    takes,
    page,
  };
}

/** The inputs besides song and leader. */
export function storedInputs(inputs: Inputs): StoredInputs {
  return Object.fromEntries(Object.entries(inputs).filter(([key]) => key !== 'song' && key !== 'leader'));
}

/** Whether the page holds anything of the visitor's own; a demo that was only watched, and its count, are not. */
export function hasVisitorContent({ takes, leader, song, countings }: AppState): boolean {
  return (
    countings.some((counting) => !song || song.label === null || !isOf(counting, song)) ||
    leader?.label === null ||
    song?.label === null ||
    takes.some(({ starred, name, reaction }) => starred || name !== null || reaction.label === null)
  );
}
