/** Longest time that is extrapolated between two readings of the song's position, seconds. */
const MAX_EXTRAPOLATION = 0.1;

/** Position of the song that is playing. */
interface SongPosition {
  /** Seconds since the start of the song. */
  readonly position: number;
  /** Seconds; NaN until the header has been read. */
  readonly length: number;
  /** Seconds into the dance at which the song begins. */
  readonly songStart: number;
}

/** The time of the dance: taken from the song while it plays, else from the computer's clock. Never runs backwards. */
export class PlaybackClock {
  /** Seconds of the dance. */
  duration = 0;
  /** Seconds of the dance per second. */
  speed = 1;
  /** Last start, in seconds of the dance and in milliseconds of `performance.now()`. */
  #start = { time: 0, atMs: 0 };
  /** Last song position that differed from the one before; `atMs` is -1 until the position has changed once. */
  #reading = { position: -1, atMs: -1 };
  /** Last time returned: a song that is just starting may read a hundredth of a second back. */
  #latest = 0;

  /** Time of the last reading, seconds. */
  get latest(): number {
    return this.#latest;
  }

  /** Time of the last start, seconds. */
  get started(): number {
    return this.#start.time;
  }

  /** Starts again at a time in seconds, kept within the duration; by default where it was started last. */
  restart(time = this.#start.time): void {
    this.#start = { time: this.#clamp(time), atMs: performance.now() };
    this.#reading = { position: -1, atMs: -1 };
    this.#latest = this.#start.time;
  }

  /** Time in seconds while playing. @param song null while none plays */
  read(song: SongPosition | null): number {
    const time = song ? this.#songTime(song) : this.#start.time + this.#elapsed(this.#start.atMs);
    this.#latest = Math.max(this.#latest, this.#clamp(time));
    return this.#latest;
  }

  /** Some browsers update the position in steps: between two of them it is extrapolated, within the song. */
  #songTime({ position, length, songStart }: SongPosition): number {
    if (position !== this.#reading.position) {
      this.#reading = { position, atMs: this.#reading.position < 0 ? -1 : performance.now() };
    }
    const { atMs } = this.#reading;
    const extrapolated = atMs < 0 ? 0 : Math.min(this.#elapsed(atMs), MAX_EXTRAPOLATION);
    return songStart + Math.min(position + extrapolated, length || Infinity);
  }

  /** Seconds of the dance since a time of `performance.now()`. */
  #elapsed(sinceMs: number): number {
    return ((performance.now() - sinceMs) / 1000) * this.speed;
  }

  #clamp(time: number): number {
    return Math.min(Math.max(0, time), this.duration);
  }
}
