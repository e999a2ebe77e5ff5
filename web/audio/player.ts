import { AudioError } from './errors';

/** The sound and the clock of the page. */
export interface Player {
  /** Seconds into the dance; while the song sounds, of what is heard just now. */
  readonly time: number;
  readonly playing: boolean;
  /**
   * Sets what is heard and how long the clock runs: silence follows a shorter song, a longer one is cut off. Keeps
   * the time and whether it plays.
   *
   * @param sound a sound file, null for silence
   * @param duration seconds
   */
  load(sound: Blob | null, duration: number): void;
  /** @throws AudioError playback-refused */
  play(): Promise<void>;
  pause(): void;
  /** Jumps to a time in seconds, kept within the duration. */
  seek(seconds: number): void;
  /** @param speed 1 is the song's own; the pitch stays */
  setSpeed(speed: number): void;
  dispose(): void;
}

/** Longest stretch that is filled in between two readings of the song's clock, seconds. */
const LONGEST_GUESS = 0.1;

/**
 * Plays a song with an <audio> element, which keeps the pitch at any speed and tells the time of what is heard, output
 * delay included. Given the decoded sound as WAV it seeks to the sample; compressed files do not. Before, after and
 * without a song a silent clock runs.
 */
export function createPlayer(): Player {
  const element = new Audio();
  element.preload = 'auto';
  let address: string | null = null;
  let duration = 0;
  let speed = 1;
  let playing = false;
  /** The silent clock: it showed `shown` seconds at `since` milliseconds. */
  let clock = { shown: 0, since: 0 };
  /** Latest new reading of the song's clock; `since` is -1 until it has been seen to move. */
  let reading = { position: -1, since: -1 };
  /** What was told last: a song that is just starting may read a hundredth of a second back. */
  let told = 0;

  const within = (seconds: number): number => Math.min(Math.max(0, seconds), duration);
  const advance = (since: number): number => ((performance.now() - since) / 1000) * speed;

  /** Starts all clocks afresh from this time. */
  const setClock = (seconds: number): void => {
    clock = { shown: within(seconds), since: performance.now() };
    reading = { position: -1, since: -1 };
    told = clock.shown;
  };

  /** Whether the song is what runs; not before it may start, and no more at its end. */
  const sounds = (): boolean => playing && !element.paused && !element.ended;

  /** The song's clock moves in steps in some browsers: between two steps its time is guessed, within the song. */
  const songTime = (): number => {
    const { currentTime } = element;
    if (currentTime !== reading.position) {
      reading = { position: currentTime, since: reading.position < 0 ? -1 : performance.now() };
    }
    const guess = reading.since < 0 ? 0 : Math.min(advance(reading.since), LONGEST_GUESS);
    // A song whose header has not been read yet has no duration: NaN.
    return Math.min(currentTime + guess, element.duration || Infinity);
  };

  const time = (): number => {
    if (playing) told = Math.max(told, within(sounds() ? songTime() : clock.shown + advance(clock.since)));
    return told;
  };

  /** Whether the song has something to say at this time. */
  const hasSong = (seconds: number): boolean =>
    address !== null && !(seconds >= element.duration - 1e-3) && seconds < duration;

  /** Puts the song where the clock is and lets it run if it should. */
  const follow = async (): Promise<void> => {
    const start = time();
    if (!hasSong(start)) {
      element.pause();
      return;
    }
    if (Math.abs(element.currentTime - start) > 1e-3) element.currentTime = start;
    if (playing) await element.play();
    else element.pause();
  };

  /** A pause, a seek or a new song while the sound was starting ends that start with an AbortError, as it should. */
  const quietly = (started: Promise<void>): void => {
    started.catch((error: unknown) => {
      if ((error as Error).name !== 'AbortError') playing = false;
    });
  };

  element.onended = () => {
    if (playing) setClock(element.duration);
  };
  element.onloadedmetadata = () => quietly(follow());
  // A song that ends after the dance would sound on.
  element.ontimeupdate = () => {
    if (!playing || element.currentTime < duration) return;
    setClock(duration);
    element.pause();
  };

  return {
    get time() {
      return time();
    },
    get playing() {
      return playing;
    },
    load(sound, seconds) {
      const now = time();
      element.pause();
      if (address !== null) URL.revokeObjectURL(address);
      address = sound && URL.createObjectURL(sound);
      duration = seconds;
      setClock(now);
      if (address === null) element.removeAttribute('src');
      else element.src = address;
      element.load();
      element.defaultPlaybackRate = speed;
      element.playbackRate = speed;
    },
    async play() {
      if (playing) return;
      playing = true;
      setClock(clock.shown);
      try {
        await follow();
      } catch (cause) {
        if ((cause as Error).name === 'AbortError') return;
        playing = false;
        throw new AudioError(
          'playback-refused',
          'The browser did not start the sound.',
          'Press play again; some browsers only allow sound after a click on the page.',
          { cause },
        );
      }
    },
    pause() {
      setClock(time());
      playing = false;
      element.pause();
    },
    seek(seconds) {
      setClock(seconds);
      quietly(follow());
    },
    setSpeed(value) {
      setClock(time());
      speed = value;
      element.defaultPlaybackRate = value;
      element.playbackRate = value;
    },
    dispose() {
      this.pause();
      this.load(null, 0);
    },
  };
}
