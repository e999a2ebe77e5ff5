import type { BodyRule } from '../motion/contact/capsules';
import type { ContactRule } from '../motion/contact/foot-contacts';
import type { GlideRule } from '../motion/contact/root-speed';

/**
 * The constants of the measures, the same as in training/evaluation/metrics. They come from Python through the manifest (its
 * `quality` block), so that a number on the page and one in a report mean the same.
 */
export interface Rules {
  readonly contact: ContactRule & {
    /** A foot in contact that is faster skates, m/s. */
    readonly slide_speed: number;
  };
  readonly penetration: BodyRule;
  readonly beats: {
    /** Standard deviation of the filter on the speed, frames. */
    readonly smoothing: number;
    /** Standard deviation of the score, frames. */
    readonly tolerance: number;
  };
  readonly seams: {
    /** Frames around a seam that belong to it. */
    readonly radius: number;
    /** Frames around a seam that are not counted as the motion's interior. */
    readonly clear: number;
  };
  readonly glide: GlideRule;
}

/** What is measured: two motions of equal length, the music's beats and the block length. */
export interface Duet {
  readonly fps: number;
  readonly frames: number;
  /** frames x 22 x 3, metres, y up. */
  readonly leader: Float32Array;
  /** frames x 22 x 3, metres, y up. */
  readonly reactor: Float32Array;
  /** Frames of the music's beats, ascending; empty without a song. */
  readonly beats: readonly number[];
  /** Frames of one block of the model. */
  readonly block: number;
}
