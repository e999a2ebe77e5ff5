/** What a reaction is generated from, the reaction itself, and takes. */
import type { Song } from '../../audio/client';
import type { Manifest } from '../../model/client';
import type { FileBytes } from '../../motion/import/read';
import type { LeaderFile } from '../../motion/retarget/leader';
import type { ImportOptions } from '../../motion/retarget/options';
import type { Role } from '../../common/role';
import type { SolvedMotion } from '../../motion/skeleton/clip';

export type Layer = 'coarse' | 'fine';

/** Guidance by stream and layer, s of the paper's Eq. 9; streams and layers as the manifest names them. */
export type Guidance = Readonly<Record<string, Readonly<Record<string, number>>>>;

export interface LoadedSong {
  readonly name: string;
  /** Where it comes from when not from the visitor: "demo song". */
  readonly label: string | null;
  /** The file as it was given, so that it can be stored and read again. */
  readonly file: Blob;
  readonly data: Song;
}

/** What a leader is read from. */
export interface LeaderSource {
  readonly name: string;
  /** Where it comes from when not from the visitor: "demo leader". */
  readonly label: string | null;
  /** The file itself, with those that belong to it after it, kept so that it can be read again in another way. */
  readonly files: readonly FileBytes[];
  /** What is set by hand about it. */
  readonly options: ImportOptions;
}

export interface LoadedLeader extends LeaderSource {
  readonly file: LeaderFile;
  /** The leader on constant bone lengths, as drawn. */
  readonly motion: SolvedMotion;
}

export interface Settings {
  readonly guidance: Guidance;
  /** Guidance weight of the music: how much of what the song changes is added to Eq. 9. */
  readonly music: number;
  /** How far the coarse layer of the seed is from the mean of several seeds; 1 leaves it as it was sampled. */
  readonly variety: number;
  /** 0 to 2^32 - 1. */
  readonly seed: number;
  /** The role that the model generates; the loaded dancer has the other one. */
  readonly role: Role;
  /** Height of the generated dancer, from the floor to the crown, metres; null in proportion to the loaded one. */
  readonly height: number | null;
  /** Whether the generated dancer's hands hold the loaded one's where they are near. */
  readonly holdHands: boolean;
}

/** The settings that are weights of guidance: they act on latents that have been sampled. */
export type Weights = Pick<Settings, 'guidance' | 'music' | 'variety'>;

/** Everything that determines a reaction. Songs and leaders are compared by identity. */
export interface Inputs {
  readonly leader: LoadedLeader;
  readonly song: LoadedSong | null;
  /** Frames of the leader by which the song starts later than the dance; below 0 it starts earlier. */
  readonly shift: number;
  readonly settings: Settings;
}

/** The model that made a reaction. */
export interface ModelIdentity {
  readonly id: string;
  readonly name: string;
  /** SHA-256 of its graphs: two models may have the same id and name. */
  readonly graphs: readonly string[];
}

export function modelIdentity({ id, name, graphs }: Manifest): ModelIdentity {
  return { id, name, graphs: Object.values(graphs).map(({ files }) => files.wasm.sha256) };
}

/** Whether both are the same model; two that are not known count as one. */
export function sameModel(one: ModelIdentity | undefined, other: ModelIdentity | undefined): boolean {
  return one?.graphs.join() === other?.graphs.join();
}

export interface Reaction {
  /** As the model generated it; what is drawn and downloaded is `reactorMotion`. */
  readonly motion: SolvedMotion;
  /**
   * The latents it was decoded from, which its coarse layer can be decoded from; null when it came ready-made, or when
   * another model than the present one made it.
   */
  readonly latents: Float32Array | null;
  /** Not known of one that an earlier page stored, or that came ready-made before the model was loaded. */
  readonly model?: ModelIdentity | undefined;
  /** What it was generated from. */
  readonly inputs: Inputs;
  /** How far the leader is from those that the model was trained on; not known of one that came ready-made. */
  readonly unfamiliarity?: number | undefined;
  /** Set when it was not computed on this page: "demo reaction". */
  readonly label: string | null;
  /** Seconds that generating it took, or null when it came ready-made. */
  readonly seconds: number | null;
}

/** A reaction in the list of takes. */
export interface Take {
  readonly id: string;
  /** Counted from 1; the take's name until the visitor gives it one. */
  readonly number: number;
  /** Given by the visitor, or null. */
  readonly name: string | null;
  readonly starred: boolean;
  /** Milliseconds since 1970. */
  readonly createdAt: number;
  readonly reaction: Reaction;
}
