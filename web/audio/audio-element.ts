/** Volumes of a fade. */
const FADE_VOLUMES = [0.12, 0.35, 0.65, 1] as const;
/** Time between two volumes: so short that the fade itself is inaudible. */
const FADE_STEP_MS = 4;

/** An <audio> element that starts and stops without a click. */
export class FadingAudio {
  readonly element = new Audio();
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor() {
    this.element.preload = 'auto';
  }

  /** Fades the sound in when it starts next. */
  fadeIn(): void {
    this.element.volume = 0;
    this.element.addEventListener('playing', () => this.#fade(FADE_VOLUMES, () => undefined), { once: true });
  }

  /** Fades the sound out, pauses and calls `onSilent`. */
  fadeOut(onSilent: () => void): void {
    this.#fade([...FADE_VOLUMES].reverse(), () => {
      this.element.pause();
      this.element.volume = 1;
      onSilent();
    });
  }

  #fade([volume, ...rest]: readonly number[], then: () => void): void {
    clearTimeout(this.#timer);
    if (volume === undefined) {
      then();
      return;
    }
    this.element.volume = volume;
    this.#timer = setTimeout(() => this.#fade(rest, then), FADE_STEP_MS);
  }
}
