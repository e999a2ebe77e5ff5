import { AppError } from '../common/error';
import { RecentCache } from '../common/recent-cache';
import { runInWorker } from '../common/run-in-worker';
import { sha256 } from '../common/sha256';
import type { Analysis } from './analyse';
import { decodeSong } from './decode';
import { type AudioRecipe, readRecipe } from './recipe';
import type { AudioTasks } from './worker';

export { AudioPlayer, type Player } from './player';
export type { BeatsPerBar } from './rhythm/metre';
export { readRecipe };
export { type Columns, columnsOf } from './waveform';

/** A loaded song. */
export interface Song extends Analysis {
  /** Seconds. */
  readonly duration: number;
}

interface LoadOptions {
  readonly signal?: AbortSignal;
  /** Is told the fraction of the whole loading that is done, 0 to 1. */
  readonly onProgress?: (fraction: number) => void;
}

/** Share of the loading time that decoding takes; the browser reports no progress of it. */
const DECODING_SHARE = 0.15;

/** Number of songs whose analysis is cached. */
const MAX_CACHED_SONGS = 3;

/** Analysed songs by `cacheKey`. */
const cachedSongs = new RecentCache<string, Song>(MAX_CACHED_SONGS);

/**
 * Decodes and analyses a song. The samples never leave the page; the analysis runs in a worker. A file with the
 * same content as one that was loaded before is taken from the cache.
 *
 * @param audioBlock the manifest's `audio` block, checked here
 * @throws {AppError} (see its codes), or the signal's reason when it is aborted
 */
export async function loadSong(
  file: Blob,
  audioBlock: Readonly<Record<string, unknown>>,
  { signal, onProgress = () => undefined }: LoadOptions = {},
): Promise<Song> {
  signal?.throwIfAborted();
  const recipe = readRecipe(audioBlock);
  onProgress(0);
  const key = await cacheKey(file, recipe);
  const song = (key !== null && cachedSongs.get(key)) || (await load(file, recipe, signal, onProgress));
  signal?.throwIfAborted();
  if (key !== null) cachedSongs.set(key, song);
  onProgress(1);
  return song;
}

async function load(
  file: Blob,
  recipe: AudioRecipe,
  signal: AbortSignal | undefined,
  onProgress: (fraction: number) => void,
): Promise<Song> {
  const decoded = await decodeSong(file);
  signal?.throwIfAborted();
  // Each song gets its own worker, so that cancelling ends its analysis at once.
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'audio' });
  const analysis = await runInWorker<AudioTasks, 'analyse'>(
    worker,
    'analyse',
    { song: decoded, recipe },
    {
      signal,
      transfers: decoded.channels.map((channel) => channel.buffer),
      onReport: (fraction) => onProgress(DECODING_SHARE + (1 - DECODING_SHARE) * fraction),
      toError: workerError,
    },
  );
  return { ...analysis, duration: decoded.duration };
}

function workerError(reason: string): AppError {
  return new AppError(
    'worker-crashed',
    `The analysis of the song stopped unexpectedly (${reason}).`,
    'Try again. If it happens again, close other tabs or use a shorter song.',
  );
}

/** SHA-256 of the file, and the recipe; null where the browser offers no hash (insecure origins). */
async function cacheKey(file: Blob, recipe: AudioRecipe): Promise<string | null> {
  if (file.size === 0) return null;
  const bytes = await file.arrayBuffer().catch(() => null);
  const sum = bytes && (await sha256(bytes));
  return sum ? `${sum} ${JSON.stringify(recipe)}` : null;
}
