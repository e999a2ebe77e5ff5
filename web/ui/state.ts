import type { Song } from '../audio/client';
import type { Manifest } from '../model/client';
import type { LeaderFile } from '../motion/bvh-read';
import type { SolvedMotion } from '../motion/clip';

export type Theme = 'dark' | 'light';
export type Camera = 'orbit' | 'follow' | 'top' | 'side';
export type Side = 'song' | 'leader';
export type Layer = 'coarse' | 'fine';

export interface LoadedSong {
  readonly name: string;
  /** Says where it comes from when not from the visitor: "demo song". */
  readonly label: string | null;
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
  /** One value per residual layer, applied to every stream. */
  readonly guidance: Readonly<Record<Layer, number>>;
  readonly steps: number;
  /** 0 to 2^32 - 1. */
  readonly seed: number;
}

/** Everything a reaction follows from. Songs and leaders are compared by identity. */
export interface Inputs {
  readonly leader: LoadedLeader;
  readonly song: LoadedSong | null;
  readonly settings: Settings;
}

export interface Reaction {
  /** As the model made it; what is drawn and taken home is `reactorMotion`. */
  readonly motion: SolvedMotion;
  /** What it was made from. */
  readonly inputs: Inputs;
  /** Set when it was not computed on this page: "demo reaction". */
  readonly label: string | null;
  /** Seconds that making it took, or null when it came ready-made. */
  readonly seconds: number | null;
}

export type ModelState =
  | {
      readonly phase: 'loading';
      /** What is being loaded, in a word. */
      readonly label: string;
      readonly received: number;
      /** Bytes in all; 0 while unknown or when there is nothing to count. */
      readonly total: number;
    }
  | {
      readonly phase: 'ready';
      readonly backend: 'webgpu' | 'wasm';
      readonly reason: string;
      readonly threads: number;
    }
  | { readonly phase: 'failed'; readonly problem: Problem };

export interface Job {
  readonly stage: 'waiting' | 'condition' | 'step' | 'decode' | 'solve';
  readonly done: number;
  readonly total: number;
  /** 0 to 1 over the whole job. */
  readonly fraction: number;
}

/** A failure in words: what is wrong, and what to do about it. */
export interface Problem {
  readonly code: string;
  readonly title: string;
  readonly hint: string;
  /** The way out that the dialog offers first. */
  readonly remedy: 'song' | 'leader' | 'any-file' | 'model' | 'generate' | 'none';
  /** The file that was refused, if it was a file. */
  readonly refused: { readonly side: Side | null; readonly name: string } | null;
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
  /** Start over at the end. */
  readonly loop: boolean;
}

export interface AppState {
  readonly theme: Theme;
  readonly camera: Camera;
  /** The first-visit block is on the stage. */
  readonly visiting: boolean;
  readonly demo: 'loading' | 'ready' | 'missing';
  readonly open: 'download' | 'keys' | null;
  readonly model: ModelState;
  readonly manifest: Manifest | null;
  /** Null until the manifest has told the defaults. */
  readonly settings: Settings | null;
  readonly song: LoadedSong | null;
  readonly leader: LoadedLeader | null;
  readonly reading: Readonly<Record<Side, Reading | null>>;
  readonly reaction: Reaction | null;
  /** Whether planted feet of the reactor are kept from sliding. */
  readonly footLock: boolean;
  readonly job: Job | null;
  readonly problem: Problem | null;
  /** Failures that came while another one was being told. */
  readonly waitingProblems: readonly Problem[];
  /** Sentences worth knowing that stop nothing. */
  readonly remarks: readonly string[];
  readonly playback: Playback;
}
