import type { MotionFormat, VideoPlan } from '../export/client';
import type { Choice } from './chooser';
import type { DroppedFile } from './dropped';
import type { Kept } from './state';
import type { Store } from './store';

/** What panels may ask for. They change settings through the store and everything with effects through here. */
export interface Services {
  /** Reads what was dropped: songs and leaders, which their content tells apart, or the folder of a model. */
  readonly openDropped: (dropped: Promise<readonly DroppedFile[]>) => void;
  /** Opens the system's file chooser. */
  readonly choose: (what: Choice) => void;
  /** Reads the leader again at this frame rate; null is the file's own. */
  readonly rereadLeader: (fps: number | null) => void;
  /** Plays the demo from its start. */
  readonly playDemo: () => void;
  /** Makes the reaction now, even if files and settings have not changed. */
  readonly generate: () => void;
  readonly cancel: () => void;
  /** Makes three reactions to pick from; where three are there already, three others. */
  readonly makeChoices: () => void;
  /** Brings the one with this seed to the stage. */
  readonly pickChoice: (seed: number) => void;
  /** Tries again to load the model. */
  readonly retryModel: () => void;
  readonly togglePlay: () => void;
  /** Jumps to a time in seconds, playing or not. */
  readonly seek: (seconds: number) => void;
  /** Frames both dancers in the picture. */
  readonly frameBoth: () => void;
  /** Writes the chosen motion in this format and hands it to the browser's downloads. */
  readonly saveMotion: (format: MotionFormat) => void;
  /** How a video would be written here and now; null when this browser can write none. */
  readonly planVideo: () => Promise<VideoPlan | null>;
  /** Films the dance in the chosen size and hands it to the browser's downloads. */
  readonly saveVideo: () => void;
  readonly cancelVideo: () => void;
  /** Passes the file that was written last on to another app, by the system's own sheet. */
  readonly shareSaved: () => void;
  /** Size of the picture on the stage in pixels; null without a stage. */
  readonly stageSize: () => { readonly width: number; readonly height: number } | null;
  /** Hands a project file with song, leader, takes and settings to the browser's downloads. */
  readonly saveProject: () => void;
  /** Empties the page of everything that is not its own; undo brings it back. */
  readonly startAfresh: () => void;
  /** What is kept on this device for the next visit; null where the browser gives no storage. */
  readonly measureKept: () => Promise<Kept | null>;
  /** Removes it; false when the browser refuses. */
  readonly clearKept: () => Promise<boolean>;
  /** Loads the newer build of the page. */
  readonly takeUpdate: () => void;
}

/** A panel puts itself into its root and returns what takes it away again. */
export type Mount = (root: HTMLElement, store: Store, services: Services) => () => void;
