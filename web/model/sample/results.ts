import type { SolvedMotion } from '../../motion/skeleton/clip';
import type { Progress } from '../progress';

/** The generated dancer, at the leader's size and as long as the leader. */
interface GeneratedMotion {
  readonly motion: SolvedMotion;
  /** The same with foot lock, made here because it would hold up the page. */
  readonly locked: SolvedMotion;
}

/** A generated dancer of whom one part is new; around it is the motion of the generation before. */
export interface Preview extends GeneratedMotion {
  /** Motion frames that are new, `to` excluded. */
  readonly fresh: { readonly from: number; readonly to: number };
}

export interface GenerateResult extends GeneratedMotion {
  /** What it was decoded from: latents x layers x channels, normalised. */
  readonly latents: Float32Array;
  /** Time of each stage; `condition` is near 0 when the memory of the last generation is used again. */
  readonly seconds: Readonly<Record<'condition' | 'steps' | 'decode' | 'solve', number>>;
}

export interface GenerateOptions {
  /** Stops the work before the next graph run; the promise is then rejected with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  readonly onProgress?: ((progress: Progress) => void) | undefined;
  /**
   * Motion frame on view: its block is generated first and handed to `onPreview`, then growing parts around it, as
   * far as preview.ts finds them worth it.
   */
  readonly at?: number | undefined;
  readonly onPreview?: ((preview: Preview) => void) | undefined;
}
