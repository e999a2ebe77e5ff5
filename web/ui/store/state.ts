/** The state of the page and the types of its parts. */
import type { View } from '../../common/framing';
import type { Theme, VisibleOverlays } from '../../common/picture';
import type { BeatsPerBar } from '../../audio/client';
import type { FrameRate, MotionFormat, VideoSize } from '../../export/client';
import type { DownloadPart, Manifest } from '../../model/client';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Report } from '../../quality/client';
import type { Asked } from './history/asked';
import type { History } from './history/history';
import type { Inputs, LeaderSource, LoadedLeader, LoadedSong, Reaction, Settings, Take } from './reaction';
import type { Span } from './time-scale';

export type InputKind = 'song' | 'leader';

/** The two takes of a comparison; one is on the stage. */
export type Letter = 'A' | 'B';

/**
 * Whether autosave works: everything is stored, the browser's space is full, it gives the page none, another tab
 * stores its own work, or a newer version of the page has stored work that this one leaves alone.
 */
export type AutosaveStatus = 'stored' | 'full' | 'refused' | 'elsewhere' | 'newer';

/** A take of an earlier visit whose leader and song are still being read. */
interface ComingTake {
  readonly id: string;
  readonly title: string;
}

/** What an earlier visit stored, while it is being read. */
export interface Restoring {
  /** Song, leader and number of takes: `descarga.mp3, leader_0412.bvh, 3 takes`. */
  readonly what: string;
  /** The newest first; those that are among `takes` already are there. */
  readonly takes: readonly ComingTake[];
}

/** How the other take is drawn: not at all, beside the one on the stage, or as a ghost in the same place. */
export type Compare = 'off' | 'side' | 'ghost';

/** Quality measures of a dance. */
export interface Quality {
  /** The motion that was measured, as drawn. */
  readonly reactor: SolvedMotion;
  readonly report: Report;
}

/** Files that belong together, the one that is named first: a song, or a leader with its skeleton. */
export type FileGroup = readonly File[];

/** Files that were given together, of which some are to be used. */
export interface GivenFiles {
  readonly songs: readonly FileGroup[];
  readonly leaders: readonly FileGroup[];
  /** Sentences about those that can't be used. */
  readonly unused: readonly string[];
}

export type ModelState =
  | {
      readonly phase: 'loading';
      /** What is being done. */
      readonly label: string;
      readonly received: number;
      /** Bytes in all; 0 while unknown, or when nothing is being downloaded. */
      readonly total: number;
      /** The files that the bytes belong to, and how many of them were cached by an earlier visit. */
      readonly parts?: readonly DownloadPart[];
    }
  | {
      readonly phase: 'ready';
      readonly backend: 'webgpu' | 'wasm';
      readonly reason: string;
    }
  | { readonly phase: 'failed'; readonly problem: Problem };

export interface Job {
  readonly stage: 'waiting' | 'condition' | 'step';
  /** 0 to 1 over the whole sampling; 0 where only weights have changed, which needs none. */
  readonly fraction: number;
}

/** What is drawn while a reaction is being generated: the previous one, with new frames around the playhead. */
export interface Preview {
  readonly motion: SolvedMotion;
  /** The same with its feet locked. */
  readonly locked: SolvedMotion;
}

/** One of several reactions to choose from. */
export interface Variation {
  /** Null until it is chosen. */
  readonly seed: number | null;
  /** Null until it is generated. */
  readonly reaction: Reaction | null;
  /** Progress of generating it, 0 to 1. */
  readonly fraction: number;
}

/** Reactions to the same files and settings that differ in their seed; their variety is above the one that was set. */
export interface Variations {
  /** What they are generated from; its seed is not used. */
  readonly inputs: Inputs;
  /** First of the consecutive seeds that theirs are chosen from. */
  readonly firstSeed: number;
  readonly list: readonly Variation[];
  /** Some are still being generated. */
  readonly making: boolean;
}

/** A failure as the visitor reads it: what is wrong, and what to do about it. */
export interface Problem {
  readonly code: string;
  readonly title: string;
  readonly hint: string;
  /** What the dialog's first button offers. */
  readonly remedy:
    | 'song'
    | 'leader'
    | 'any-file'
    | 'read-again'
    | 'model'
    | 'own-model'
    | 'generate'
    | 'project'
    | 'reload'
    | 'none';
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
  /** The part of the dance that is looped, seconds. */
  readonly region: Span | null;
}

/** The dancers by where they come from, since their roles can be swapped. */
export type DancerSelection = 'generated' | 'loaded' | 'both';

/** The choices in the download menu. */
export interface DownloadChoice {
  readonly who: DancerSelection;
  /** The whole dance, or the part of it that is looped as long as there is one. */
  readonly part: 'whole' | 'loop';
  readonly format: MotionFormat;
  /** Frames a second of a motion. */
  readonly rate: FrameRate;
  readonly size: VideoSize;
  /** Written into the first seconds of a video, and below all of it; empty for none. */
  readonly title: string;
  readonly credit: string;
  /** Whether a video also shows the leader's video, if there is one, in half of its picture. */
  readonly beside: boolean;
}

/** A video that is being written. */
export interface VideoProgress {
  /** Pictures written. */
  readonly frame: number;
  readonly frames: number;
  /** Estimated time to the end; null while there is too little to estimate from. */
  readonly secondsLeft: number | null;
}

/** The generated dancer decoded from the coarse layer alone. While it is being decoded, the previous one stays. */
export interface CoarseLayer {
  readonly motion: SolvedMotion | null;
  /** That of the other take, while both are drawn; null until it is decoded. */
  readonly other: SolvedMotion | null;
  readonly decoding: boolean;
}

/** The file that was written last. */
export interface Saved {
  readonly name: string;
  readonly bytes: number;
  /** Whether the system can share it with other apps. */
  readonly shareable: boolean;
}

/** A drag of a fader, until the reaction to where it ended is there. */
export interface Drag {
  /** The pointer has not released it yet. */
  readonly held: boolean;
  /** Id of the take that its reactions have made. */
  readonly take: string | null;
}

/** How a song is counted. */
export interface Counting {
  readonly beatsPerBar: BeatsPerBar;
  /** Counted beats to a beat that was found. */
  readonly rate: 0.5 | 1 | 2;
  /** The time of a "1", seconds of the song. */
  readonly one: number;
}

/** How the visitor counts a song, which is known by its file's name and size. */
export interface SongCounting extends Counting {
  readonly song: string;
  readonly bytes: number;
}

/** The dance of the first seconds of a video. */
export interface PartRead {
  readonly leader: LoadedLeader;
  /** The moment of it that the stage shows, seconds. */
  readonly time: number;
}

/** A sentence about what has just happened; the same one again is another one. */
interface Toast {
  readonly text: string;
}

export interface AppState {
  readonly theme: Theme;
  readonly camera: View;
  readonly overlays: VisibleOverlays;
  readonly coarse: CoarseLayer;
  /** The first-visit block is on the stage. */
  readonly firstVisit: boolean;
  readonly demo: 'loading' | 'ready' | 'missing';
  readonly openPanel:
    'import' | 'download' | 'keys' | 'project' | 'takes' | 'device' | 'overlays' | 'counting' | null;
  /** A newer build of the page is cached and can be loaded. */
  readonly update: boolean;
  readonly model: ModelState;
  readonly manifest: Manifest | null;
  /** Null until the manifest has given the defaults. */
  readonly settings: Settings | null;
  readonly song: LoadedSong | null;
  readonly leader: LoadedLeader | null;
  /** The last leader that could not be read, so that it can be read again in another way. */
  readonly refusedLeader: LeaderSource | null;
  /** As in `Inputs`; 0 while there is no leader. */
  readonly shift: number;
  /** The songs that are counted otherwise than was found, the last one changed first. */
  readonly countings: readonly SongCounting[];
  /** The next click on ruler or song says where a "1" is. */
  readonly settingOne: boolean;
  readonly reading: Readonly<Record<InputKind, Reading | null>>;
  readonly reaction: Reaction | null;
  readonly preview: Preview | null;
  readonly drag: Drag | null;
  /** The reaction before the last change of a setting, for as long as the stage shows it as a ghost. */
  readonly earlier: Reaction | null;
  readonly variations: Variations | null;
  /** Whether the seed stays when a reaction is generated again. */
  readonly seedLocked: boolean;
  /** Whether letters, digits and signs are shortcuts. */
  readonly letterKeys: boolean;
  /** The newest first; the one whose reaction is `reaction` is on the stage. */
  readonly takes: readonly Take[];
  /** The highest number that a take has had. */
  readonly takesMade: number;
  /** Id of the take that the one on the stage is compared with. */
  readonly other: string | null;
  /** The letter of the take on the stage; the compared take has the other letter. */
  readonly letter: Letter;
  readonly compare: Compare;
  readonly history: History;
  /** What undo can end the reading of, the last one asked for last. */
  readonly asked: readonly Asked[];
  readonly autosave: AutosaveStatus;
  /** Whether the browser keeps what is stored even when space is short; null while nobody has asked it. */
  readonly persistent: boolean | null;
  readonly restoring: Restoring | null;
  /** Whether feet in contact with the floor are kept from sliding (see `withFootLock`). */
  readonly footLock: boolean;
  /** Of the motion that was measured last, which may be the one before the one on the stage. */
  readonly quality: Quality | null;
  /** Scores of recorded dances, where a report lies beside the model. */
  readonly reference: Reference | null;
  readonly job: Job | null;
  readonly download: DownloadChoice;
  /** The format in which a motion or a picture is being written. */
  readonly writing: MotionFormat | 'png' | null;
  readonly videoProgress: VideoProgress | null;
  /** The file that was handed to the browser's downloads last. */
  readonly saved: Saved | null;
  /** Shown as a list to choose from. */
  readonly given: GivenFiles | null;
  readonly problem: Problem | null;
  /** Failures that came while another one was shown. */
  readonly queuedProblems: readonly Problem[];
  /** Sentences to know about that stop nothing. */
  readonly notices: readonly string[];
  /** Shown for a few seconds. */
  readonly toast: Toast | null;
  readonly playback: Playback;
  /** What has been read of a leader's video while the rest is being read. */
  readonly partRead: PartRead | null;
  /** How much of the stage the video covers, from the left, CSS pixels. */
  readonly covered: number;
  /** The part of the dance that the lanes show, seconds; null shows all of it. */
  readonly zoom: Span | null;
}

/** Scores of the recorded dances on which a model was tested: people do not score perfectly either. */
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
