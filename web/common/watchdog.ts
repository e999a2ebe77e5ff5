/** How long a worker may be silent, seconds. */
export interface Timeouts {
  /** Before its first message, while the script is still on its way. */
  readonly first: number;
  /** Between two messages. */
  readonly next: number;
}

/** How often a timeout is checked while it runs. */
const CHECKS = 30;

/**
 * Notices that a worker is silent. A check counts as its share of the timeout however late it comes: while the machine
 * sleeps or the browser slows the page down, the silence does not grow.
 */
export class Watchdog {
  readonly #timeouts: Timeouts;
  readonly #ask: () => Promise<unknown>;
  readonly #onSilent: (seconds: number) => void;
  #timer: ReturnType<typeof setInterval> | undefined;
  #heard = false;
  #asking = false;
  /** Checks since the last message. */
  #checks = 0;

  /**
   * @param ask asks the worker for an answer; resolves with it
   * @param onSilent called once, with the seconds waited
   */
  constructor(timeouts: Timeouts, ask: () => Promise<unknown>, onSilent: (seconds: number) => void) {
    this.#timeouts = timeouts;
    this.#ask = ask;
    this.#onSilent = onSilent;
  }

  /** Begins to check, if it does not yet. */
  start(): void {
    if (this.#timer !== undefined) return;
    this.#checks = 0;
    this.#setTimer();
  }

  stop(): void {
    clearInterval(this.#timer);
    this.#timer = undefined;
  }

  /** The worker has said something: the silence begins anew. */
  readonly reset = (): void => {
    this.#checks = 0;
    if (this.#heard) return;
    this.#heard = true;
    if (this.#timer !== undefined) this.#setTimer();
  };

  get #seconds(): number {
    return this.#heard ? this.#timeouts.next : this.#timeouts.first;
  }

  #setTimer(): void {
    clearInterval(this.#timer);
    this.#timer = setInterval(this.#check, (this.#seconds * 1000) / CHECKS);
  }

  readonly #check = (): void => {
    this.#checks++;
    if (this.#checks > CHECKS) {
      this.stop();
      this.#onSilent(this.#seconds);
    } else if (!this.#asking) {
      this.#asking = true;
      void this.#ask().then(() => {
        this.#asking = false;
        this.reset();
      });
    }
  };
}
