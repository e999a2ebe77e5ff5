import type { DroppedFile } from './dropped';
import type { Side } from './state';
import type { Store } from './store';

/** What panels may ask for. They change settings through the store and everything with effects through here. */
export interface Services {
  /** Reads what was dropped: songs and leaders, which their content tells apart, or the folder of a model. */
  readonly openDropped: (dropped: Promise<readonly DroppedFile[]>) => void;
  /** Opens the system's file chooser. */
  readonly choose: (side: Side | 'any') => void;
  /** Reads the leader again at this frame rate; null is the file's own. */
  readonly rereadLeader: (fps: number | null) => void;
  /** Plays the demo from its start. */
  readonly playDemo: () => void;
  /** Makes the reaction now, even if files and settings have not changed. */
  readonly generate: () => void;
  readonly cancel: () => void;
  /** Tries again to load the model. */
  readonly retryModel: () => void;
  readonly togglePlay: () => void;
  /** Jumps to a time in seconds, playing or not. */
  readonly seek: (seconds: number) => void;
  /** Frames both dancers in the picture. */
  readonly frameBoth: () => void;
  /** Hands the reactor's BVH to the browser's downloads. */
  readonly saveReactor: () => void;
}

/** A panel puts itself into its root and returns what takes it away again. */
export type Mount = (root: HTMLElement, store: Store, services: Services) => () => void;
