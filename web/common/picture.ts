/** How a picture of the couple is drawn, as far as the page chooses it: theme, size and overlays. */

export type Theme = 'dark' | 'light';

/** Pixels. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** Which overlays the stage draws in addition to the dancers. */
export interface VisibleOverlays {
  /** Bones and joints; the bodies are see-through then. */
  readonly skeleton: boolean;
  readonly trails: boolean;
  readonly contacts: boolean;
  readonly facing: boolean;
  readonly hands: boolean;
  /** The motion of the coarse layer alone, as a dancer of its own. */
  readonly ghost: boolean;
}

/** The overlays of a first visit. */
export const NO_OVERLAYS: VisibleOverlays = {
  skeleton: false,
  trails: false,
  contacts: false,
  facing: false,
  hands: false,
  ghost: false,
};
