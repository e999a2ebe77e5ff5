import { AppError } from '../common/error';
import { runInWorker } from '../common/run-in-worker';
import type { Analysis } from './analyse';
import { decodeSong } from './decode';
import { type AudioRecipe, readRecipe } from './recipe';
import type { AudioTasks } from './worker';

export { AudioPlayer, type Player } from './player';

/** A loaded song. */
export interface Song extends Analysis {
  /** Seconds. */
  readonly duration: number;
  /** Hz of `pcm`. */
  readonly sampleRate: number;
}

export interface LoadProgress {
  readonly stage: 'decode' | 'features';
  /** Of the whole loading, 0 to 1. */
  readonly fraction: number;
}

export interface LoadOptions {
  readonly signal?: AbortSignal;
  readonly onProgress?: (progress: LoadProgress) => void;
}

/** Share of the loading that decoding takes; the browser says nothing while it lasts. */
const DECODING_SHARE = 0.15;

/** Songs whose analysis is remembered. */
const REMEMBERED = 3;

/** Analyses by the hash of file and recipe, the most recently used last. */
const analyses = new Map<string, Song>();

/**
 * Decodes and analyses a song. The samples never leave the page; the heavy part runs in a worker. A file that was
 * loaded before, by content, comes back at once.
 *
 * @param audioBlock the manifest's `audio` block, checked here
 * @throws {AppError} (see its codes), or the signal's reason when it is aborted
 */
export async function loadSong(
  file: Blob | ArrayBuffer,
  audioBlock: Readonly<Record<string, unknown>>,
  { signal, onProgress = () => undefined }: LoadOptions = {},
): Promise<Song> {
  signal?.throwIfAborted();
  const blob = file instanceof Blob ? file : new Blob([file]);
  const recipe = readRecipe(audioBlock);
  onProgress({ stage: 'decode', fraction: 0 });
  const key = await fingerprint(blob, recipe);
  const song = (key !== null && analyses.get(key)) || (await load(blob, recipe, signal, onProgress));
  signal?.throwIfAborted();
  if (key !== null) remember(key, song);
  onProgress({ stage: 'features', fraction: 1 });
  return song;
}

async function load(
  file: Blob,
  recipe: AudioRecipe,
  signal: AbortSignal | undefined,
  onProgress: (progress: LoadProgress) => void,
): Promise<Song> {
  const decoded = await decodeSong(file);
  signal?.throwIfAborted();
  // Every song gets a worker of its own, so that cancelling ends its analysis at once.
  const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'audio' });
  const analysis = await runInWorker<AudioTasks, 'analyse'>(
    worker,
    'analyse',
    { song: decoded, recipe },
    {
      signal,
      transfers: decoded.channels.map((channel) => channel.buffer),
      onReport: (fraction) =>
        onProgress({ stage: 'features', fraction: DECODING_SHARE + (1 - DECODING_SHARE) * fraction }),
      toError: crash,
    },
  );
  return { ...analysis, duration: decoded.duration, sampleRate: recipe.sample_rate };
}

function crash(reason: string): AppError {
  return new AppError(
    'worker-crashed',
    `The analysis of the song stopped unexpectedly (${reason}).`,
    'Load the song again. If it happens again, close other tabs or use a shorter song.',
  );
}

/** SHA-256 of the file, with the recipe; null where the browser offers no hash (pages without a secure origin). */
async function fingerprint(file: Blob, recipe: AudioRecipe): Promise<string | null> {
  const subtle = globalThis.crypto.subtle as SubtleCrypto | undefined;
  if (!subtle || file.size === 0) return null;
  const bytes = await file.arrayBuffer().catch(() => null);
  if (!bytes) return null;
  const hash = new Uint8Array(await subtle.digest('SHA-256', bytes));
  return `${Array.from(hash, (byte) => byte.toString(16).padStart(2, '0')).join('')} ${JSON.stringify(recipe)}`;
}

function remember(key: string, song: Song): void {
  analyses.delete(key);
  analyses.set(key, song);
  const [oldest] = analyses.keys();
  if (analyses.size > REMEMBERED && oldest !== undefined) analyses.delete(oldest);
}
