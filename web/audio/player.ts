import { createDeck, type Deck } from './audio-element';
import { AppError } from '../common/error';

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
  /** Says when in the dance the song begins, seconds; below 0 its beginning is not heard. Keeps the time. */
  setSongStart(seconds: number): void;
  /**
   * Goes round in a part of the dance, seconds: from its end, or from the dance's, to its start. Null ends that.
   * Whatever lies before the part is played into it.
   */
  setLoop(loop: { readonly from: number; readonly to: number } | null): void;
  /** @throws {AppError} playback-refused */
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
/** A turn or an entry this close is there, seconds. */
const NEAR = 0.002;
/** Shortest wait for one, milliseconds. */
const SHORTEST_WAIT = 4;

/**
 * Plays a song with <audio> elements, which keep the pitch at any speed and tell the time of what is heard, output
 * delay included. Given the decoded sound as WAV they seek to the sample; compressed files do not. Before, after and
 * without a song a silent clock runs. A loop is gone round on two elements in turn: the next one waits at the loop's
 * start, so that neither a search nor a click is heard.
 */
export function createPlayer(): Player {
  let deck = createDeck();
  let next = createDeck();
  let address: string | null = null;
  let duration = 0;
  let songStart = 0;
  let loop: { readonly from: number; readonly to: number } | null = null;
  let speed = 1;
  let playing = false;
  let timer: ReturnType<typeof setTimeout> | undefined;
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
  const sounds = (): boolean => playing && !deck.element.paused && !deck.element.ended;

  /** The song's clock moves in steps in some browsers: between two steps its time is guessed, within the song. */
  const songTime = (): number => {
    const { currentTime, duration: length } = deck.element;
    if (currentTime !== reading.position) {
      reading = { position: currentTime, since: reading.position < 0 ? -1 : performance.now() };
    }
    const guess = reading.since < 0 ? 0 : Math.min(advance(reading.since), LONGEST_GUESS);
    // A song whose header has not been read yet has no duration: NaN.
    return songStart + Math.min(currentTime + guess, length || Infinity);
  };

  const time = (): number => {
    if (playing) told = Math.max(told, within(sounds() ? songTime() : clock.shown + advance(clock.since)));
    return told;
  };

  /** Whether the song has something to say at this time of the dance. */
  const hasSong = (seconds: number): boolean => {
    const position = seconds - songStart;
    if (address === null || position < 0 || seconds >= duration) return false;
    return !(position >= deck.element.duration - 1e-3);
  };

  /** Puts the song where the clock is and lets it run if it should. */
  const follow = async (): Promise<void> => {
    const start = time();
    const { element } = deck;
    if (!hasSong(start)) {
      element.pause();
      return;
    }
    if (Math.abs(element.currentTime + songStart - start) > 1e-3) element.currentTime = start - songStart;
    if (playing) await element.play();
    else element.pause();
  };

  /** A pause, a seek or a new song while the sound was starting ends that start with an AbortError, as it should. */
  const quietly = (started: Promise<void>): void => {
    started.catch((error: unknown) => {
      if ((error as Error).name !== 'AbortError') playing = false;
    });
  };

  /** Lets the other element wait where the loop begins. */
  const cue = (): void => {
    if (loop && hasSong(loop.from)) next.element.currentTime = loop.from - songStart;
  };

  const goRound = (to: number): void => {
    setClock(to);
    if (hasSong(to)) {
      [deck, next] = [next, deck];
      deck.fadeIn();
      next.fadeOut(cue);
    }
    quietly(follow());
    watchAhead();
  };

  /** Waits for what comes next by itself: the end of the loop, or the song after a silence. */
  const watchAhead = (): void => {
    clearTimeout(timer);
    if (!playing) return;
    const now = time();
    const turn = loop ? (now < loop.to ? loop.to : duration) : Infinity;
    const entry = address !== null && now < songStart ? songStart : Infinity;
    const ahead = Math.min(turn, entry);
    if (ahead === Infinity) return;
    const wait = Math.max(SHORTEST_WAIT, ((ahead - now) / speed) * 1000);
    timer = setTimeout(() => {
      if (time() < ahead - NEAR) watchAhead();
      else if (loop && ahead === turn) goRound(loop.from);
      else {
        // Timers may come a little early: the song starts at its first sample.
        if (time() < songStart) setClock(songStart);
        quietly(follow());
        watchAhead();
      }
    }, wait);
  };

  const prepare = (each: Deck): void => {
    const { element } = each;
    element.onended = () => {
      if (playing && each === deck) setClock(element.duration + songStart);
    };
    element.onloadedmetadata = () => {
      if (each === deck) quietly(follow());
      else cue();
    };
    // A song that ends after the dance would sound on.
    element.ontimeupdate = () => {
      if (!playing || each !== deck || element.currentTime + songStart < duration) return;
      setClock(duration);
      element.pause();
    };
  };
  prepare(deck);
  prepare(next);

  /** Changes something that the clocks follow from, at the time that is shown. */
  const change = (apply: () => void): void => {
    const now = time();
    apply();
    setClock(now);
    watchAhead();
  };

  return {
    get time() {
      return time();
    },
    get playing() {
      return playing;
    },
    load(sound, seconds) {
      change(() => {
        for (const { element } of [deck, next]) element.pause();
        if (address !== null) URL.revokeObjectURL(address);
        address = sound && URL.createObjectURL(sound);
        duration = seconds;
      });
      for (const { element } of [deck, next]) {
        if (address === null) element.removeAttribute('src');
        else element.src = address;
        element.load();
        element.defaultPlaybackRate = speed;
        element.playbackRate = speed;
      }
    },
    setSongStart(seconds) {
      if (seconds === songStart) return;
      change(() => {
        songStart = seconds;
      });
      quietly(follow());
      cue();
    },
    setLoop(part) {
      loop = part;
      cue();
      watchAhead();
    },
    async play() {
      if (playing) return;
      playing = true;
      setClock(clock.shown);
      try {
        watchAhead();
        await follow();
      } catch (cause) {
        if ((cause as Error).name === 'AbortError') return;
        playing = false;
        throw new AppError(
          'playback-refused',
          'The browser did not start the sound.',
          'Press play again; some browsers only allow sound after a click on the page.',
          { cause },
        );
      }
    },
    pause() {
      clearTimeout(timer);
      setClock(time());
      playing = false;
      for (const { element } of [deck, next]) element.pause();
    },
    seek(seconds) {
      setClock(seconds);
      quietly(follow());
      watchAhead();
    },
    setSpeed(value) {
      change(() => {
        speed = value;
      });
      for (const { element } of [deck, next]) {
        element.defaultPlaybackRate = value;
        element.playbackRate = value;
      }
    },
    dispose() {
      this.pause();
      this.load(null, 0);
    },
  };
}
