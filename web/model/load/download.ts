import { AppError } from '../../common/error';
import { sha256 } from '../../common/sha256';
import type { ManifestFile } from '../manifest';

/** Stores verified files between visits; in the page, the Cache API. */
export interface FileStore {
  get(key: string): Promise<Uint8Array<ArrayBuffer> | undefined>;
  /** @throws when the file cannot be stored, for example because storage is full */
  put(key: string, bytes: Uint8Array<ArrayBuffer>): Promise<void>;
  /** Deletes all other files of the same owner. */
  keepOnly(keys: readonly string[]): Promise<void>;
}

export interface DownloadOptions {
  readonly fetch: typeof fetch;
  /** Undefined where the browser has no storage for the page. */
  readonly store?: FileStore | undefined;
  /** SHA-256 of further files of the same owner that stay in the store. */
  readonly alsoKeep?: readonly string[] | undefined;
  /** Bytes that are loaded, bytes in all, and how many of the loaded ones came from the store. */
  readonly onProgress?: ((loaded: number, total: number, cached: number) => void) | undefined;
  /** Called once, when a file could not be stored; the download goes on without storing any. */
  readonly onCacheFailure?: ((reason: unknown) => void) | undefined;
  /** Nothing is fetched before this has come. */
  readonly after?: Promise<unknown> | undefined;
}

/** A model's files by their path inside its folder, as in 'manifest.json'. */
export type ModelFolder = Readonly<Record<string, Blob>>;

const MISSING_HINT = 'Check that the model folder was copied to the server, then load the page again.';

/**
 * Fetch something that must not be a page: servers of single-page apps answer a missing file with 200 and HTML, and so
 * does a network, to everything, until its user has signed in.
 * @throws {AppError} `model-missing`, `web-page-instead` or `download-failed`
 */
export async function fetchFile(
  url: string,
  get: typeof fetch,
  options: RequestInit = {},
): Promise<Response> {
  let response: Response;
  try {
    // Ask the server each time: a manifest and graphs of different age would not fit each other.
    response = await get(url, { cache: 'no-cache', ...options });
  } catch (error) {
    if (error instanceof AppError) throw error;
    throw new AppError(
      'download-failed',
      `The model file ${url.replace(/^.*\//, '')} could not be fetched.`,
      'Check the connection, then try again.',
      { cause: error },
    );
  }
  if (!response.ok) {
    const missing = response.status === 404 || response.status === 410;
    throw new AppError(
      missing ? 'model-missing' : 'download-failed',
      `The server answered ${response.status} for the model file ${url}.`,
      missing ? MISSING_HINT : 'Try again in a moment.',
    );
  }
  if (response.headers.get('content-type')?.toLowerCase().includes('text/html') === true) {
    throw new AppError(
      'web-page-instead',
      `The server sent a web page instead of the model file ${url}.`,
      `If this network asks you to sign in, do so and try again. ${MISSING_HINT}`,
    );
  }
  return response;
}

/** Under what name the store has the beginning of a file whose download broke off. */
const beginningOf = ({ sha256 }: ManifestFile): string => `${sha256}-beginning`;

/**
 * Fetches a file, from where an earlier attempt broke off if the store has its beginning.
 * @param onBytes told how many bytes of the file are here
 */
async function fetchBytes(
  url: string,
  file: ManifestFile,
  { fetch: get, store }: DownloadOptions,
  onBytes: (bytes: number) => void,
): Promise<Uint8Array<ArrayBuffer>> {
  const beginning = (await store?.get(beginningOf(file)).catch(() => undefined)) ?? new Uint8Array();
  const response = await fetchFile(
    url,
    get,
    beginning.length > 0 ? { cache: 'no-store', headers: { range: `bytes=${beginning.length}-` } } : {},
  );
  // A server that sends no parts of files answers with the whole.
  const isRest = response.status === 206;
  const parts = isRest ? [beginning] : [];
  let loaded = isRest ? beginning.length : 0;
  try {
    const reader = response.body?.getReader();
    for (let part = await reader?.read(); part?.value !== undefined; part = await reader?.read()) {
      parts.push(part.value);
      loaded += part.value.length;
      onBytes(loaded);
    }
  } catch (error) {
    // A rest is sent without compression: where the whole is smaller with it, as the runtime is, that comes again.
    const whole = Number(response.headers.get('content-length')) || file.bytes;
    if (loaded < file.bytes && (isRest || file.bytes - loaded < whole))
      await store?.put(beginningOf(file), joined(parts)).catch(() => undefined);
    if (error instanceof AppError) throw error;
    throw new AppError(
      'download-failed',
      `The download of the model file ${url} broke off after ${(loaded / 1e6).toFixed(1)} MB.`,
      'Check the connection, then try again.',
      { cause: error },
    );
  }
  return joined(parts);
}

function joined(parts: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** What is wrong with the bytes, compared to the manifest; undefined for nothing. */
async function mismatch(bytes: Uint8Array<ArrayBuffer>, file: ManifestFile): Promise<string | undefined> {
  if (bytes.length !== file.bytes) return `${bytes.length} bytes instead of ${file.bytes}`;
  const sum = await sha256(bytes);
  return sum === undefined || sum === file.sha256 ? undefined : `SHA-256 ${sum} instead of ${file.sha256}`;
}

/** The files that the store has, as the manifest lists them; undefined for the others. */
function lookUp(
  files: readonly ManifestFile[],
  store: FileStore | undefined,
): Promise<(Uint8Array<ArrayBuffer> | undefined)[]> {
  return Promise.all(
    files.map(async (file) => {
      // A store that fails or holds other bytes is as good as an empty one.
      const bytes = await store?.get(file.sha256).catch(() => undefined);
      return bytes !== undefined && (await mismatch(bytes, file)) === undefined ? bytes : undefined;
    }),
  );
}

/**
 * Get files, from the store where it has them, and verify them against the manifest.
 * @param base address that the files' paths are relative to
 * @returns the files' bytes, in order
 * @throws what `after` rejects with
 * @throws {AppError} `model-missing`, `web-page-instead`, `download-failed`, or `model-corrupt` when bytes differ from the manifest
 */
export async function download(
  base: string,
  files: readonly ManifestFile[],
  options: DownloadOptions,
): Promise<Uint8Array<ArrayBuffer>[]> {
  const { store, alsoKeep = [], after, onProgress, onCacheFailure } = options;
  const total = files.reduce((sum, file) => sum + file.bytes, 0);
  const found = await lookUp(files, store);
  const cached = found.reduce((sum, bytes) => sum + (bytes?.length ?? 0), 0);
  let loaded = cached;
  const report = (more: number): void => onProgress?.(Math.min(loaded + more, total), total, cached);
  report(0);
  await after;
  let storeFailed = false;
  const results: Uint8Array<ArrayBuffer>[] = [];
  for (const [index, file] of files.entries()) {
    const stored = found[index];
    if (stored !== undefined) {
      results.push(stored);
      continue;
    }
    const url = new URL(file.path, base).href;
    const bytes = await fetchBytes(url, file, options, report);
    const wrong = await mismatch(bytes, file);
    if (wrong !== undefined) {
      // It may be the beginning that is wrong.
      await store?.put(beginningOf(file), new Uint8Array()).catch(() => undefined);
      throw new AppError(
        'model-corrupt',
        `The model file ${file.path} is not the one its manifest lists: ${wrong}.`,
        'Reload the page; if this happens again, copy the whole model folder to the server once more.',
      );
    }
    try {
      if (!storeFailed) await store?.put(file.sha256, bytes);
    } catch (error) {
      storeFailed = true;
      onCacheFailure?.(error);
    }
    loaded += file.bytes;
    report(0);
    results.push(bytes);
  }
  await store?.keepOnly([...files.map((file) => file.sha256), ...alsoKeep]).catch(() => undefined);
  return results;
}

const FOLDER_HINT = 'Drop the whole folder onto the page again.';

/**
 * A `fetch` that answers from a folder of files.
 *
 * @param root address that the paths are relative to; nothing is ever asked of it
 * @throws {AppError} from the request: `model-missing` for a file that the folder does not have, or has no longer
 */
export function folderFetch(folder: ModelFolder, root: string): typeof fetch {
  const files = new Map(
    Object.entries(folder).map(([path, file]) => [new URL(path, root).href, { path, file }]),
  );
  return async (address) => {
    const url = address instanceof Request ? address.url : String(address);
    const found = files.get(url);
    if (!found) {
      const name = url.slice(new URL('.', root).href.length);
      throw new AppError('model-missing', `The folder of the model has no file ${name}.`, FOLDER_HINT);
    }
    try {
      return new Response(await found.file.arrayBuffer());
    } catch (cause) {
      throw new AppError(
        'model-missing',
        `The file ${found.path} of the model can’t be read any more: it was moved, changed or deleted.`,
        FOLDER_HINT,
        { cause },
      );
    }
  };
}
