/** How long to wait for a sign of life, seconds. */
export interface Patience {
  /** Before the first one, while the script is still on its way. */
  readonly first: number;
  /** Between two of them. */
  readonly next: number;
}

/** Looks into the wait. */
const LOOKS = 30;

/**
 * Notices that a worker gives no more sign of life. A look counts as its share of the wait however late it comes: while
 * the machine sleeps or the browser slows the page down, the silence does not grow.
 */
export class SilenceWatch {
  readonly #patience: Patience;
  readonly #ask: () => Promise<unknown>;
  readonly #onSilent: (seconds: number) => void;
  #timer: ReturnType<typeof setInterval> | undefined;
  #heard = false;
  #asking = false;
  /** Looks since the last sign of life. */
  #looks = 0;

  /**
   * @param ask asks for a sign of life; resolves with it
   * @param onSilent called once, with the seconds waited
   */
  constructor(patience: Patience, ask: () => Promise<unknown>, onSilent: (seconds: number) => void) {
    this.#patience = patience;
    this.#ask = ask;
    this.#onSilent = onSilent;
  }

  /** Begins to look, if it does not yet. */
  start(): void {
    if (this.#timer !== undefined) return;
    this.#looks = 0;
    this.#setTimer();
  }

  stop(): void {
    clearInterval(this.#timer);
    this.#timer = undefined;
  }

  /** There was a sign of life. */
  readonly hear = (): void => {
    this.#looks = 0;
    if (this.#heard) return;
    this.#heard = true;
    if (this.#timer !== undefined) this.#setTimer();
  };

  get #seconds(): number {
    return this.#heard ? this.#patience.next : this.#patience.first;
  }

  #setTimer(): void {
    clearInterval(this.#timer);
    this.#timer = setInterval(this.#look, (this.#seconds * 1000) / LOOKS);
  }

  readonly #look = (): void => {
    this.#looks++;
    if (this.#looks > LOOKS) {
      this.stop();
      this.#onSilent(this.#seconds);
    } else if (!this.#asking) {
      this.#asking = true;
      void this.#ask().then(() => {
        this.#asking = false;
        this.hear();
      });
    }
  };
}
