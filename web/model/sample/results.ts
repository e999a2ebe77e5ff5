import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Progress } from '../progress';
import type { Playhead } from './playhead';

/** The generated dancer at the leader's size. */
export interface GeneratedMotion {
  readonly motion: SolvedMotion;
  /** The same with foot lock, made here because it would hold up the page. */
  readonly locked: SolvedMotion;
}

/** A part of a generated dancer, shown before the whole is there. It is that part of the whole, but for a millimetre. */
export interface Preview extends GeneratedMotion {
  /** The frame of the whole dance at which this part begins. */
  readonly from: number;
}

export interface GenerateResult extends GeneratedMotion {
  /** How far the leader is from those of training, about 1 for one of them; mean over the clip. */
  readonly unfamiliarity: number;
  /** What it was decoded from: latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  /** Time of each stage. `steps`, which includes the condition graph, is near 0 when only weights have changed. */
  readonly seconds: Readonly<Record<'steps' | 'decode' | 'solve', number>>;
}

export interface SeedsOptions {
  /** Stops the work as in `GenerateOptions`. */
  readonly signal?: AbortSignal | undefined;
  /** Called with the share of the dances that are there, 0 to 1. */
  readonly onProgress?: ((share: number) => void) | undefined;
}

export interface GenerateOptions {
  /** Stops the work before the next graph run; the promise is then rejected with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((progress: Progress) => void) | undefined;
  /** Where the dance is on view: the part around it is handed to `onPreview` before the whole is decoded. */
  readonly playhead?: Playhead | undefined;
  /** The whole is begun when this has returned, so that the caller can abort it first. */
  readonly onPreview?: ((preview: Preview) => void | Promise<void>) | undefined;
}
