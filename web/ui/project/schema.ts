import type { Manifest } from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { AppState, Compare, Inputs, Letter, LoadedLeader, LoadedSong, Reaction } from '../store/state';
import { presentInputs, takeOnStage } from '../store/take';

/** A song as it is kept: the file that it was read from. */
export interface KeptSong {
  readonly id: string;
  readonly name: string;
  readonly label: string | null;
  readonly file: Blob;
}

export interface KeptLeader {
  readonly id: string;
  readonly name: string;
  readonly label: string | null;
  readonly text: string;
  readonly fps: number | null;
}

export interface KeptMotion {
  readonly id: string;
  readonly motion: SolvedMotion;
  /** Left out where the motion came ready-made, or was kept before latents were. */
  readonly latents?: KeptLatents;
}

/** What a motion was decoded from, as in `Reaction`. */
export interface KeptLatents {
  /** The decoder to which they mean something, as `decoderOf` names it. */
  readonly decoder: string;
  readonly values: Float32Array;
}

/** Tells decoders apart, whatever their models are called: by the hash of their graph. */
export function decoderOf({ graphs }: Manifest): string {
  return graphs.decode.files.wasm.sha256;
}

/** What a reaction is made from besides song and leader: settings, and whatever else `Inputs` has. */
export type KeptInputs = Readonly<Record<string, unknown>>;

export interface KeptTake {
  readonly id: string;
  readonly number: number;
  readonly name: string | null;
  readonly starred: boolean;
  readonly createdAt: number;
  readonly label: string | null;
  readonly seconds: number | null;
  /** Ids of the parts. */
  readonly motion: string;
  readonly leader: string;
  readonly song: string | null;
  readonly inputs: KeptInputs;
}

/** What is on the page, by ids. */
export interface KeptPage {
  readonly leader: string | null;
  readonly song: string | null;
  /** Null while there was no leader. */
  readonly inputs: KeptInputs | null;
  readonly shown: string | null;
  readonly other: string | null;
  readonly letter: Letter;
  readonly compare: Compare;
  readonly takesMade: number;
  readonly footLock: boolean;
  /** Seconds. */
  readonly time: number;
}

/** Everything that survives a reload and that a project file holds, as plain data without analyses. */
export interface Kept {
  readonly songs: readonly KeptSong[];
  readonly leaders: readonly KeptLeader[];
  readonly motions: readonly KeptMotion[];
  readonly takes: readonly KeptTake[];
  readonly page: KeptPage;
}

/** The id under which an object is kept; the same object has the same id for as long as the page lives. */
const ids = new WeakMap<object, string>();

function idOf(part: object): string {
  let id = ids.get(part);
  if (id === undefined) {
    id = Array.from(crypto.getRandomValues(new Uint8Array(8)), (byte) =>
      byte.toString(16).padStart(2, '0'),
    ).join('');
    ids.set(part, id);
  }
  return id;
}

/** Says under which id an object that was read back is kept already. */
export function knownAs(part: object, id: string): void {
  ids.set(part, id);
}

/** Takes the state apart into what is kept of it. */
export function keep(state: AppState): Kept {
  const songs = new Map<string, KeptSong>();
  const leaders = new Map<string, KeptLeader>();
  const motions = new Map<string, KeptMotion>();
  const song = (part: LoadedSong | null): string | null => {
    if (!part) return null;
    const { name, label, file } = part;
    const id = idOf(part);
    songs.set(id, { id, name, label, file });
    return id;
  };
  const leader = (part: LoadedLeader): string => {
    const { name, label, text, fps } = part;
    const id = idOf(part);
    leaders.set(id, { id, name, label, text, fps });
    return id;
  };
  const motion = ({ motion: part, latents: values }: Reaction): string => {
    const id = idOf(part);
    const latents = values && state.manifest && { decoder: decoderOf(state.manifest), values };
    motions.set(id, { id, motion: part, ...(latents && { latents }) });
    return id;
  };

  const takes = state.takes.map(({ id, number, name, starred, createdAt, reaction }): KeptTake => {
    const { label, seconds, inputs } = reaction;
    const parts = {
      motion: motion(reaction),
      leader: leader(inputs.leader),
      song: song(inputs.song),
      inputs: otherInputs(inputs),
    };
    return { id, number, name, starred, createdAt, label, seconds, ...parts };
  });
  const inputs = presentInputs(state);
  const { other, letter, compare, takesMade, footLock, playback } = state;
  const page: KeptPage = {
    leader: state.leader ? leader(state.leader) : null,
    song: song(state.song),
    inputs: inputs ? otherInputs(inputs) : null,
    shown: takeOnStage(state)?.id ?? null,
    other,
    letter,
    compare,
    takesMade,
    footLock,
    time: playback.time,
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
export function otherInputs(inputs: Inputs): KeptInputs {
  return Object.fromEntries(Object.entries(inputs).filter(([key]) => key !== 'song' && key !== 'leader'));
}

/** Whether the page holds anything of the visitor's own; a demo that was only watched is none. */
export function worthKeeping({ takes, leader, song }: AppState): boolean {
  return (
    leader?.label === null ||
    song?.label === null ||
    takes.some(({ starred, name, reaction }) => starred || name !== null || reaction.label === null)
  );
}
