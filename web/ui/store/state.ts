import type { Song } from '../../audio/client';
import type { MotionFormat, VideoSize } from '../../export/client';
import type { DownloadPart, Manifest } from '../../model/client';
import type { LeaderFile } from '../../motion/bvh/read';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Kept } from '../../offline/storage-usage';
import type { Report } from '../../quality/client';
import type { History } from './history';
import type { Span } from './time-scale';

export type { Kept };

export type Theme = 'dark' | 'light';
export type Camera = 'orbit' | 'follow' | 'top' | 'side';
export type InputKind = 'song' | 'leader';
export type Layer = 'coarse' | 'fine';
export type Role = 'leader' | 'reactor';

/** Guidance by stream and layer, s of the paper's Eq. 9; streams and layers as the manifest names them. */
export type Guidance = Readonly<Record<string, Readonly<Record<string, number>>>>;

export interface LoadedSong {
  readonly name: string;
  /** Says where it comes from when not from the visitor: "demo song". */
  readonly label: string | null;
  /** The file as it was given, so that it can be kept and read again. */
  readonly file: Blob;
  readonly data: Song;
}

export interface LoadedLeader {
  readonly name: string;
  readonly label: string | null;
  /** The file itself, kept so that it can be read again at another frame rate. */
  readonly text: string;
  /** Frame rate set by hand instead of the file's own, frames per second. */
  readonly fps: number | null;
  readonly file: LeaderFile;
  /** The leader on constant bone lengths, as drawn. */
  readonly motion: SolvedMotion;
}

export interface Settings {
  readonly guidance: Guidance;
  /** How much of what the song changes is added to Eq. 9. */
  readonly music: number;
  readonly steps: number;
  /** 0 to 2^32 - 1. */
  readonly seed: number;
  /** Whose part the model dances; the loaded dancer has the other one. */
  readonly role: Role;
}

/** Everything a reaction follows from. Songs and leaders are compared by identity. */
export interface Inputs {
  readonly leader: LoadedLeader;
  readonly song: LoadedSong | null;
  /** Frames of the leader by which the song starts later than the dance; below 0 it starts earlier. */
  readonly shift: number;
  readonly settings: Settings;
}

export interface Reaction {
  /** As the model made it; what is drawn and taken home is `reactorMotion`. */
  readonly motion: SolvedMotion;
  /** What the model decoded it from, with which its coarse layer can be seen; null when it came ready-made. */
  readonly latents: Float32Array | null;
  /** What it was made from. */
  readonly inputs: Inputs;
  /** Set when it was not computed on this page: "demo reaction". */
  readonly label: string | null;
  /** Seconds that making it took, or null when it came ready-made. */
  readonly seconds: number | null;
}

/** A reaction that is kept, with what it was made from. */
export interface Take {
  readonly id: string;
  /** Counted up from 1; names the take until the visitor does. */
  readonly number: number;
  /** Given by the visitor, or null. */
  readonly name: string | null;
  readonly starred: boolean;
  /** Milliseconds since 1970. */
  readonly createdAt: number;
  readonly reaction: Reaction;
}

/** The two places of a comparison; one is on the stage. */
export type Letter = 'A' | 'B';

/** Whether the browser keeps what is on the page: it does, its space is full, or it gives the page none. */
export type AutosaveStatus = 'kept' | 'full' | 'refused';

/** How the other take is seen beside the one on the stage. */
export type Compare = 'off' | 'side' | 'ghost';

/** Measures of a dance. */
export interface Quality {
  /** The motion that was measured, as drawn. */
  readonly reactor: SolvedMotion;
  readonly report: Report;
}

export type ModelState =
  | {
      readonly phase: 'loading';
      /** What is being loaded, in a word. */
      readonly label: string;
      readonly received: number;
      /** Bytes in all; 0 while unknown or when there is nothing to count. */
      readonly total: number;
      /** What those bytes are of, and how many were kept here since an earlier visit. */
      readonly parts?: readonly DownloadPart[];
    }
  | {
      readonly phase: 'ready';
      readonly backend: 'webgpu' | 'wasm';
      readonly reason: string;
      readonly threads: number;
    }
  | { readonly phase: 'failed'; readonly problem: Problem };

export interface Job {
  readonly stage: 'waiting' | 'condition' | 'preview' | 'step' | 'decode' | 'solve';
  readonly done: number;
  readonly total: number;
  /** 0 to 1 over the whole job. */
  readonly fraction: number;
  /** Frames in which the stage shows the new reaction already, nearly as it will be. */
  readonly previewed: FrameRange | null;
}

/** Motion frames `from` to `to`, the latter excluded. */
export interface FrameRange {
  readonly from: number;
  readonly to: number;
}

/** What is drawn while a reaction is being made: the one before, with the part under the playhead made anew. */
export interface Preview {
  readonly motion: SolvedMotion;
  /** The same with its feet locked. */
  readonly locked: SolvedMotion;
}

/** One of several reactions to pick from. */
export interface Variation {
  readonly seed: number;
  /** Null until it is made. */
  readonly reaction: Reaction | null;
  /** How far it is made, 0 to 1. */
  readonly fraction: number;
}

/** Reactions to the same files and settings that differ in their seed. */
export interface Variations {
  /** What they are made from; the seed in it counts for nothing. */
  readonly inputs: Inputs;
  readonly list: readonly Variation[];
  /** Some are still being made. */
  readonly making: boolean;
}

/** A failure in words: what is wrong, and what to do about it. */
export interface Problem {
  readonly code: string;
  readonly title: string;
  readonly hint: string;
  /** The way out that the dialog offers first. */
  readonly remedy: 'song' | 'leader' | 'any-file' | 'model' | 'generate' | 'project' | 'none';
  /** The file that was refused, if it was a file. */
  readonly refused: { readonly kind: InputKind | null; readonly name: string } | null;
}

export interface Reading {
  readonly name: string;
  /** 0 to 1. */
  readonly fraction: number;
}

export interface Playback {
  readonly playing: boolean;
  /** Seconds from the start of the dance. */
  readonly time: number;
  readonly speed: number;
  /** Start over at the end, of the region if there is one. */
  readonly loop: boolean;
  /** The part of the dance that a loop goes round in, seconds. */
  readonly region: Span | null;
}

export type Who = 'reactor' | 'leader' | 'both';

/** What was last chosen in the download menu. */
export interface DownloadChoice {
  readonly who: Who;
  readonly format: MotionFormat;
  readonly size: VideoSize;
}

/** A video that is being written. */
export interface VideoProgress {
  /** Pictures written. */
  readonly frame: number;
  readonly frames: number;
  /** Seconds that the rest will take; null while nobody can tell. */
  readonly secondsLeft: number | null;
}

/** What is drawn on the stage beside the dancers; `ghost` is the coarse layer. */
export interface Overlays {
  readonly skeleton: boolean;
  readonly trails: boolean;
  readonly contacts: boolean;
  readonly facing: boolean;
  readonly hands: boolean;
  readonly ghost: boolean;
}

/** The made dancer whom the coarse layer alone says. While another is being decoded, the one before stays. */
export interface CoarseLayer {
  readonly motion: SolvedMotion | null;
  /** That of the other take, while it stands beside the one on the stage; null until it is decoded. */
  readonly other: SolvedMotion | null;
  readonly decoding: boolean;
}

/** The file that was written last. */
export interface Saved {
  readonly name: string;
  readonly bytes: number;
  /** Whether the system can pass it on to other apps. */
  readonly shareable: boolean;
}

export interface AppState {
  readonly theme: Theme;
  readonly camera: Camera;
  readonly overlays: Overlays;
  readonly coarse: CoarseLayer;
  /** The first-visit block is on the stage. */
  readonly firstVisit: boolean;
  readonly demo: 'loading' | 'ready' | 'missing';
  readonly openPanel: 'download' | 'keys' | 'project' | 'takes' | 'device' | 'overlays' | null;
  /** A newer build of the page is here and waits to be taken. */
  readonly update: boolean;
  readonly model: ModelState;
  readonly manifest: Manifest | null;
  /** Null until the manifest has told the defaults. */
  readonly settings: Settings | null;
  readonly song: LoadedSong | null;
  readonly leader: LoadedLeader | null;
  /** As in `Inputs`; 0 while there is no leader. */
  readonly shift: number;
  readonly reading: Readonly<Record<InputKind, Reading | null>>;
  readonly reaction: Reaction | null;
  readonly preview: Preview | null;
  readonly variations: Variations | null;
  /** The seed stays as it is when a reaction is made again. */
  readonly seedLocked: boolean;
  /** The newest first; the one on the stage is the one whose reaction is `reaction`. */
  readonly takes: readonly Take[];
  /** Takes numbered so far. */
  readonly takesMade: number;
  /** The take that the one on the stage is compared with, by its id. */
  readonly other: string | null;
  /** The letter of the take on the stage; the other take has the other one. */
  readonly letter: Letter;
  readonly compare: Compare;
  readonly history: History;
  readonly autosave: AutosaveStatus;
  /** Whether planted feet of the reactor are kept from sliding. */
  readonly footLock: boolean;
  /** Of the newest reactor that was measured; that may be the one before the one on the stage. */
  readonly quality: Quality | null;
  /** What recorded dances score, where a report lies beside a model. */
  readonly reference: Reference | null;
  readonly job: Job | null;
  readonly download: DownloadChoice;
  /** The format in which a motion is being written. */
  readonly writing: MotionFormat | null;
  readonly videoProgress: VideoProgress | null;
  /** The file that was handed to the browser's downloads last. */
  readonly saved: Saved | null;
  readonly problem: Problem | null;
  /** Failures that came while another one was being told. */
  readonly queuedProblems: readonly Problem[];
  /** Sentences worth knowing that stop nothing. */
  readonly notices: readonly string[];
  /** What has just happened, told for a moment. */
  readonly toast: string | null;
  readonly playback: Playback;
  /** The part of the dance that the lanes show, seconds; null shows all of it. */
  readonly zoom: Span | null;
}

/** What the recorded dances score on which a model was tested: neither perfect nor zero, as people aren't. */
export interface Reference {
  /** The model's id. */
  readonly model: string;
  readonly skateShare: number | null;
  readonly contactShare: number | null;
  /** Metres a second. */
  readonly slideSpeed: number | null;
  readonly overlapShare: number | null;
  readonly music: number | null;
  readonly leader: number | null;
}
