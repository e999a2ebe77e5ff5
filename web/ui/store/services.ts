import type { PictureSize, Theme } from '../../common/picture';
import type { Role } from '../../common/role';
import type { Song } from '../../audio/client';
import type { MotionFormat, VideoPlan } from '../../export/client';
import type { Manifest } from '../../model/client';
import type { LeaderRequest, ReadLeader } from '../../motion/client';
import type { Inspection } from '../../motion/import/inspect';
import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { StorageUsage } from '../../offline/storage-usage';
import type { Report } from '../../quality/client';
import type { LeaderSource, LoadedLeader, LoadedSong } from './reaction';
import type { ImportOptions } from '../../motion/retarget/options';
import type { InputKind } from './state';
import type { Store } from './store';

/** What the system's file chooser is asked for. */
export type FileChoice = InputKind | 'any' | 'project';

/** A file with the path it was dropped under: `my model/step.onnx`, or only its name. */
export interface DroppedFile {
  readonly path: string;
  readonly file: File;
}

/** The functions that files are read with, as arguments so that reading can be tested without a browser. */
export interface FileReaders {
  readonly loadSong: (
    file: Blob,
    recipe: Manifest['audio'],
    options: { signal: AbortSignal; onProgress: (fraction: number) => void },
  ) => Promise<Song>;
  readonly readLeader: (request: LeaderRequest, signal: AbortSignal) => Promise<ReadLeader>;
  /** Songs are analysed by the audio recipe of the model's manifest. */
  readonly manifest: () => Promise<Manifest>;
}

/** Reading songs and leaders from files. */
export interface Files {
  /** Reads files that the visitor gave; of a video given as the song, its sound. */
  readonly open: (files: readonly File[], as?: FileChoice) => Promise<void>;
  /** Reads one song and puts it on the page; the label says where it comes from when not from the visitor. */
  readonly openSong: (blob: Blob, name: string, label: string | null) => Promise<LoadedSong | null>;
  readonly openLeader: (source: LeaderSource) => Promise<LoadedLeader | null>;
  /** Says that a song or leader could not be read; `again` is what trying again does where the page has failed. */
  readonly fail: (error: unknown, side: InputKind, name: string, again: () => void) => void;
  /** Ends the reading of a song or leader that is no longer wanted. */
  readonly cancel: (side: InputKind) => void;
  /** Reads a leader again that was loaded or refused, with other options. */
  readonly rereadLeader: (source: LeaderSource, options: ImportOptions) => Promise<LoadedLeader | null>;
  /**
   * Reads a song without putting it on the page, under its name at once and in fact when `after` resolves; null when
   * that failed or a newer song cancelled it.
   */
  readonly readSong: (
    blob: Blob,
    name: string,
    label: string | null,
    after: Promise<void>,
  ) => Promise<LoadedSong | null>;
  /** The same for a leader. */
  readonly readLeader: (source: LeaderSource) => Promise<LoadedLeader | null>;
}

/** A dancer alone in one moment, seen from a direction (radians about y, 0 looks from +z). */
export interface Figure {
  readonly motion: SolvedMotion;
  readonly seconds: number;
  readonly role: Role;
  readonly heading: number;
  readonly theme: Theme;
}

/** Actions with effects that panels start. The state itself they change through the store. */
export interface Services {
  /** Reads what was dropped: songs and leaders, which their content tells apart, or the folder of a model. */
  readonly openDropped: (dropped: Promise<readonly DroppedFile[]>) => void;
  /** Reads these of the files that were given together. */
  readonly useGiven: (files: readonly File[]) => void;
  /** Opens the system's file chooser. */
  readonly choose: (what: FileChoice) => void;
  /** Opens the file of one of the `OFFERED_LEADERS`. */
  readonly openOffered: (file: string) => void;
  /** Records a leader with the webcam. */
  readonly recordVideo: () => void;
  /** Reads a leader again that was loaded or refused, with what was set by hand. */
  readonly rereadLeader: (source: LeaderSource, options: ImportOptions) => void;
  /** Reads the song or leader again whose reading failed last. */
  readonly readAgain: (kind: InputKind) => void;
  /** The joints of a leader that was loaded or refused; rejects where its file can't be read. */
  readonly inspectLeader: (source: LeaderSource) => Promise<Inspection>;
  /** Plays the demo from its start. */
  readonly playDemo: () => void;
  /** Generates the reaction now, even if files and settings have not changed. */
  readonly generate: () => void;
  readonly cancel: () => void;
  /** Undoes what the visitor did last: a step, or the request for a song or leader that is still being read. */
  readonly undo: () => void;
  readonly redo: () => void;
  /** Generates three reactions that differ in their seed; where there are three already, three others. */
  readonly makeVariations: () => void;
  /** Draws a dancer into a canvas, or clears it, as soon as it can; null where the browser cannot draw the 3D view. */
  readonly drawFigure: ((canvas: HTMLCanvasElement, figure: Figure | null) => void) | null;
  /** Shows the one with this seed on the stage. */
  readonly pickVariation: (seed: number) => void;
  /** Tries again to load the model. */
  readonly retryModel: () => void;
  /** Tries again to open the visitor's own model that failed last, and generates with it. */
  readonly reopenModel: () => void;
  readonly togglePlay: () => void;
  /** Jumps to a time in seconds, playing or not. */
  readonly seek: (seconds: number) => void;
  /** Loops the seconds around a moment that a measure marks, and shows it from where it is seen. */
  readonly showMoment: (measure: keyof Report, seconds: number) => void;
  /** Frames both dancers in the picture. */
  readonly frameBoth: () => void;
  /** Turns the camera about the dancers (radians) and changes its distance by a factor. */
  readonly stepCamera: (turn: number, factor: number) => void;
  /** Writes the chosen motion in this format and hands it to the browser's downloads. */
  readonly saveMotion: (format: MotionFormat) => void;
  /** How a video would be written with the present choices; null when this browser can write none. */
  readonly planVideo: () => Promise<VideoPlan | null>;
  /** Renders the dance as a video of the chosen size and hands it to the browser's downloads. */
  readonly saveVideo: () => void;
  /** Draws the moment that the stage shows as a PNG of the chosen size and hands it to the browser's downloads. */
  readonly savePicture: () => void;
  /** The video that the leader is from: open, so that it can be shown beside the dance, or gone since only motion is stored. */
  readonly leaderVideo: () => 'open' | 'gone' | 'none';
  readonly cancelVideo: () => void;
  /** Shares the file that was written last with another app, by the system's own dialog. */
  readonly shareSaved: () => void;
  /** Size of the chosen video in pixels; null without a stage. */
  readonly videoSize: () => PictureSize | null;
  /** Hands a project file with song, leader, takes and settings to the browser's downloads. */
  readonly saveProject: () => void;
  /** Stores the work of this tab from now on, no longer that of another tab. */
  readonly storeHere: () => void;
  /** Empties the page and loads the demo; undo brings back what was there. */
  readonly clearProject: () => void;
  /** Bytes of the page that are cached on this device; null where the browser gives no storage. */
  readonly measureStorage: () => Promise<StorageUsage | null>;
  /** Empties that cache; false when the browser refuses. */
  readonly clearStorage: () => Promise<boolean>;
  /** Loads the newer build of the page. */
  readonly loadUpdate: () => void;
  /** Loads the page again. */
  readonly reload: () => void;
}

/** Builds a panel into its root, where it stays. */
export type Mount = (root: HTMLElement, store: Store, services: Services) => void;
