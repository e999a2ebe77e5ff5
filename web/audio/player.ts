import { AudioElementPair } from './audio-element-pair';
import { AppError } from '../common/error';
import { PlaybackClock } from './playback-clock';

/** Part of the dance, seconds. */
interface Loop {
  readonly from: number;
  readonly to: number;
}

/** What playback does next without a call, and when in the dance, seconds. */
interface PlannedEvent {
  readonly kind: 'loop' | 'song-start';
  readonly time: number;
}

/** Seconds by which a timer may come early. */
const TIMER_TOLERANCE = 0.002;
/** Seconds by which the song may be off without being moved. */
const SYNC_TOLERANCE = 1e-3;
const MIN_TIMER_MS = 4;

/**
 * Plays a song with <audio> elements, which keep the pitch at any speed and report the position that is audible now,
 * output delay included. In WAV files they seek to the exact sample, in compressed files they do not. Before, after
 * and without a song the time comes from the computer's clock. A loop alternates between two elements, of which the
 * idle one waits at the start of the loop, so that there is neither a gap nor a click.
 */
export class AudioPlayer {
  /** Is told when playback stops by itself: the song could not be started later, at its place in the dance or in a loop. */
  onFailure: ((error: AppError) => void) | null = null;
  readonly #elements = new AudioElementPair();
  readonly #clock = new PlaybackClock();
  #songStart = 0;
  #loop: Loop | null = null;
  #playing = false;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor() {
    for (const element of this.#elements.both) this.#listen(element);
  }

  /** Seconds into the dance; while the song plays, of what is audible now. */
  get time(): number {
    if (!this.#playing) return this.#clock.latest;
    const { paused, ended, currentTime, duration } = this.#elements.active;
    const songStart = this.#songStart;
    // Until the event comes that starts the clock at the end of the song, it is the time.
    const ending = ended && this.#clock.started < duration + songStart;
    if (!ending && (paused || ended)) return this.#clock.read(null);
    return this.#clock.read({ position: currentTime, length: duration, songStart });
  }

  get playing(): boolean {
    return this.#playing;
  }

  /**
   * Sets the sound and the duration of the dance: silence follows a shorter song, a longer one is cut off. Keeps the
   * time and whether it plays.
   *
   * @param sound a sound file, null for silence
   * @param duration seconds
   */
  load(sound: Blob | null, duration: number): void {
    this.#changeKeepingTime(() => {
      this.#elements.setSource(sound);
      this.#clock.duration = duration;
    });
    this.#elements.setSpeed(this.#clock.speed);
  }

  /** Sets when in the dance the song begins, seconds; below 0 its beginning is cut off. Keeps the time. */
  setSongStart(seconds: number): void {
    if (seconds === this.#songStart) return;
    const { time } = this;
    this.#songStart = seconds;
    this.seek(time);
    this.#cueIdle();
  }

  /**
   * Repeats a part of the dance: from its end, or from the end of the dance, playback goes on at its start. A playhead
   * before the part plays on into it. Null ends the loop.
   */
  setLoop(loop: Loop | null): void {
    this.#loop = loop;
    this.#cueIdle();
    this.#schedule();
  }

  /** @throws {AppError} playback-refused */
  async play(): Promise<void> {
    if (this.#playing) return;
    this.#playing = true;
    this.#clock.restart();
    try {
      this.#schedule();
      await this.#syncSong();
    } catch (cause) {
      if (isAbort(cause)) return;
      this.#playing = false;
      throw playbackRefused(cause);
    }
  }

  pause(): void {
    clearTimeout(this.#timer);
    this.#clock.restart(this.time);
    this.#playing = false;
    this.#elements.pause();
  }

  /** Jumps to a time in seconds, kept within the duration. */
  seek(seconds: number): void {
    this.#clock.restart(seconds);
    // A song that plays is moved before its position is read as the time.
    this.#syncInBackground(this.#clock.latest);
    this.#schedule();
  }

  /** @param speed 1 is the song's own; the pitch stays */
  setSpeed(speed: number): void {
    this.#changeKeepingTime(() => {
      this.#clock.speed = speed;
    });
    this.#elements.setSpeed(speed);
  }

  /** Changes something that the time depends on without a jump in time. */
  #changeKeepingTime(change: () => void): void {
    const { time } = this;
    change();
    this.#clock.restart(time);
    this.#schedule();
  }

  #listen(element: HTMLAudioElement): void {
    element.onended = () => {
      if (this.#playing && element === this.#elements.active)
        this.#clock.restart(element.duration + this.#songStart);
    };
    element.onloadedmetadata = () => {
      if (element === this.#elements.active) this.#syncInBackground();
      else this.#cueIdle();
    };
    // A song that is longer than the dance stops at the end of the dance.
    element.ontimeupdate = () => {
      if (!this.#playing || element !== this.#elements.active) return;
      if (element.currentTime + this.#songStart < this.#clock.duration) return;
      this.#clock.restart(this.#clock.duration);
      element.pause();
    };
  }

  /** Whether the song covers this time of the dance. */
  #hasSong(time: number): boolean {
    const position = time - this.#songStart;
    if (!this.#elements.hasSource || position < 0 || time >= this.#clock.duration) return false;
    // A song whose header has not been read yet has no duration: NaN.
    return !(position >= this.#elements.active.duration - SYNC_TOLERANCE);
  }

  /** Moves the song to a time of the dance and starts it if playing. */
  async #syncSong(time = this.time): Promise<void> {
    const element = this.#elements.active;
    if (!this.#hasSong(time)) {
      element.pause();
      return;
    }
    const position = time - this.#songStart;
    if (Math.abs(element.currentTime - position) > SYNC_TOLERANCE) element.currentTime = position;
    if (this.#playing) await element.play();
    else element.pause();
  }

  /** A pause, a seek or a new song ends a start under way with an AbortError, which is no failure. */
  #syncInBackground(time?: number): void {
    this.#syncSong(time).catch((error: unknown) => {
      if (isAbort(error) || !this.#playing) return;
      this.pause();
      this.onFailure?.(playbackRefused(error));
    });
  }

  /** Moves the idle element to the start of the loop. */
  #cueIdle(): void {
    if (this.#loop && this.#hasSong(this.#loop.from))
      this.#elements.idle.currentTime = this.#loop.from - this.#songStart;
  }

  /** Sets a timer for the next planned event. */
  #schedule(): void {
    clearTimeout(this.#timer);
    if (!this.#playing) return;
    const { time } = this;
    const event = this.#nextEvent(time);
    if (!event) return;
    const waitMs = Math.max(MIN_TIMER_MS, ((event.time - time) / this.#clock.speed) * 1000);
    this.#timer = setTimeout(() => this.#handle(event), waitMs);
  }

  #nextEvent(time: number): PlannedEvent | null {
    const loopEnd = this.#loop && (time < this.#loop.to ? this.#loop.to : this.#clock.duration);
    const songAhead = this.#elements.hasSource && time < this.#songStart;
    if (songAhead && (loopEnd === null || this.#songStart < loopEnd))
      return { kind: 'song-start', time: this.#songStart };
    return loopEnd === null ? null : { kind: 'loop', time: loopEnd };
  }

  #handle({ kind, time }: PlannedEvent): void {
    if (this.time < time - TIMER_TOLERANCE) {
      this.#schedule();
    } else if (kind === 'loop' && this.#loop) {
      this.#restartLoop(this.#loop.from);
    } else {
      // Timers may come a little early: the song starts at its first sample.
      if (this.time < this.#songStart) this.#clock.restart(this.#songStart);
      this.#syncInBackground();
      this.#schedule();
    }
  }

  #restartLoop(from: number): void {
    if (this.#hasSong(from)) this.#elements.swap(() => this.#cueIdle());
    this.seek(from);
  }
}

/** What the page uses of the player. */
export type Player = Pick<AudioPlayer, keyof AudioPlayer>;

function playbackRefused(cause: unknown): AppError {
  return new AppError(
    'playback-refused',
    'The browser did not start the sound.',
    'Press play again; some browsers only allow sound after a click on the page.',
    { cause },
  );
}

function isAbort(error: unknown): boolean {
  return (error as Error).name === 'AbortError';
}
