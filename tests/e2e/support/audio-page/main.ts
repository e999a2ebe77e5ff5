/** The audio client without the app around it, for browser tests to call. */
import { AudioPlayer, loadSong, type Song } from '../../../../web/audio/client';
import { encodeWav } from '../../../../web/audio/wav';
import { quietlyBegunMp3 } from '../../../web/support/audio/made-mp3';

/** What a test loads: a file of the server, a text, an MP3 whose duration browsers guess wrongly, or silence. */
export type Source =
  { url: string } | { text: string } | 'quietly begun MP3' | { silentSeconds: number; rate: number };

/** A failure as data, for the test's process. */
export interface ErrorData {
  readonly name: string;
  readonly code: string | undefined;
  readonly message: string;
  readonly hint: string | undefined;
}

/** A song as data, without its samples. */
export interface SongData {
  readonly duration: number;
  readonly samples: number;
  readonly frames: number;
  readonly columns: number;
  readonly tempo: number;
  readonly beats: number;
  readonly silent: boolean;
  readonly peak: number;
  /** Seconds at which a click begins after 50 ms without one. */
  readonly clicks: number[];
  readonly progress: number[];
  readonly seconds: number;
  /** Longest time between two frames that the page drew meanwhile, seconds. */
  readonly maxFrameInterval: number;
}

async function open(source: Source): Promise<Blob> {
  if (source === 'quietly begun MP3') return new Blob([quietlyBegunMp3()]);
  if ('url' in source) return (await fetch(source.url)).blob();
  if ('text' in source) return new Blob([source.text]);
  return encodeWav([new Float32Array(source.silentSeconds * source.rate)], source.rate);
}

function findClicks({ waveform: { low, high, rate, loudest } }: Song): number[] {
  const clicks: number[] = [];
  let quietSince = -Infinity;
  high.forEach((highest, i) => {
    if ((Math.max(highest, -low[i]!) / 127) * loudest < 0.1) return;
    if (i - quietSince > 0.05 * rate) clicks.push(i / rate);
    quietSince = i;
  });
  return clicks;
}

/** Measures the time between frames of the page until the result is called, which returns the longest in seconds. */
function measureFrameIntervals(): () => number {
  let [longest, last, running] = [0, performance.now(), true];
  const frame = (): void => {
    longest = Math.max(longest, performance.now() - last);
    last = performance.now();
    if (running) requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  return () => {
    running = false;
    frame();
    return longest / 1000;
  };
}

let song: Song | undefined;

/** The <audio> elements of the page, the player's first: their state shows what is audible. */
const elements: HTMLAudioElement[] = [];
window.Audio = class extends Audio {
  constructor() {
    super();
    elements.push(this);
  }
};
const player = new AudioPlayer();
/** Codes of the failures that stopped it. */
const failures: string[] = [];
player.onFailure = ({ code }) => failures.push(code);

export const page = {
  player,

  failures: (): string[] => failures,

  /** Loads a song; aborts at the fraction `abortAt` of the progress. */
  async load(
    source: Source,
    recipe: Record<string, unknown>,
    abortAt = Infinity,
  ): Promise<SongData | { error: ErrorData }> {
    const file = await open(source);
    const controller = new AbortController();
    const progress: number[] = [];
    const started = performance.now();
    const stopWatching = measureFrameIntervals();
    try {
      song = await loadSong(file, recipe, {
        signal: controller.signal,
        onProgress: (fraction) => {
          progress.push(fraction);
          if (fraction >= abortAt) controller.abort();
        },
      });
      return {
        duration: song.duration,
        samples: Math.round(song.duration * Number(recipe['sample_rate'])),
        frames: song.frames,
        columns: song.features.length / song.frames,
        tempo: song.rhythm.tempo,
        beats: song.rhythm.beats.length,
        silent: song.silent,
        peak: song.waveform.loudest,
        clicks: findClicks(song),
        progress,
        seconds: (performance.now() - started) / 1000,
        maxFrameInterval: stopWatching(),
      };
    } catch (error) {
      const { name, code, message, hint } = error as ErrorData;
      return { error: { name, code, message, hint } };
    } finally {
      stopWatching();
    }
  },

  /** Features of the song loaded last, row by row. */
  features(): number[] {
    return Array.from(song?.features ?? []);
  },

  /** Loads the song loaded last, silence or an invalid sound into the player. */
  setSound(what: 'song' | 'silence' | 'nonsense', duration: number): void {
    const sounds = { song: song?.sound ?? null, silence: null, nonsense: new Blob(['la la la']) };
    player.load(sounds[what], duration);
  },

  /** Plays; returns the failure if there is one. */
  async play(): Promise<ErrorData | null> {
    try {
      await player.play();
      return null;
    } catch (error) {
      const { name, code, message, hint } = error as ErrorData;
      return { name, code, message, hint };
    }
  },

  /** Seconds of the song that are heard now; null when there is silence. */
  heard(): number | null {
    const [element] = elements.filter(({ paused, ended }) => !paused && !ended);
    return element ? element.currentTime : null;
  },

  /** Reads both clocks at every frame and event of the song for some seconds: [the page's, the player's] in seconds. */
  async watch(seconds: number): Promise<[number, number][]> {
    const readings: [number, number][] = [];
    const read = (): void => void readings.push([performance.now() / 1000, player.time]);
    const watched = [...elements];
    for (const element of watched) element.addEventListener('timeupdate', read);
    const start = performance.now();
    while (performance.now() - start < seconds * 1000) {
      await new Promise(requestAnimationFrame);
      read();
    }
    for (const element of watched) element.removeEventListener('timeupdate', read);
    return readings;
  },
};

export type Page = typeof page;
Object.assign(globalThis, { audio: page });
