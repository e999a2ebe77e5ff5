import { AppError } from '../../common/error';
import type { ManifestFile } from '../manifest';

/** Keeps verified files between visits; the page's is the Cache API. */
export interface FileStore {
  get(key: string): Promise<Uint8Array<ArrayBuffer> | undefined>;
  /** @throws when the file cannot be kept, for example for want of space */
  put(key: string, bytes: Uint8Array<ArrayBuffer>): Promise<void>;
  /** Forget every other file of the model. */
  keepOnly(keys: readonly string[]): Promise<void>;
}

export interface DownloadOptions {
  readonly fetch: typeof fetch;
  /** Undefined where the browser has no storage for the page. */
  readonly store?: FileStore | undefined;
  /** Further files of the same owner that may be wanted again, by their SHA-256. */
  readonly spare?: readonly string[] | undefined;
  /** Bytes that are here, bytes in all, and how many of those the store had. */
  readonly onProgress?: ((loaded: number, total: number, kept: number) => void) | undefined;
  /** Called once, when a file could not be kept; the download goes on without keeping any. */
  readonly onUnkept?: ((reason: unknown) => void) | undefined;
}

const MISSING_HINT = 'Check that the model folder was copied to the server, then load the page again.';

/** Lower-case hexadecimal SHA-256; undefined on an insecure origin, where the browser does not offer it. */
export async function sha256(bytes: Uint8Array<ArrayBuffer>): Promise<string | undefined> {
  const subtle = (globalThis.crypto as Crypto | undefined)?.subtle;
  if (subtle === undefined) return undefined;
  const digest = new Uint8Array(await subtle.digest('SHA-256', bytes));
  return Array.from(digest, (byte) => byte.toString(16).padStart(2, '0')).join('');
}

/**
 * Fetch something that must not be a page: servers of single-page apps answer a missing file with 200 and HTML.
 * @throws {AppError} `model-missing` or `download-failed`
 */
export async function fetchFile(url: string, get: typeof fetch): Promise<Response> {
  let response: Response;
  try {
    // Ask the server each time: a manifest and graphs of different age would not fit each other.
    response = await get(url, { cache: 'no-cache' });
  } catch (error) {
    throw new AppError(
      'download-failed',
      `The model file ${url} could not be fetched.`,
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
      'model-missing',
      `The server sent a web page instead of the model file ${url}.`,
      MISSING_HINT,
    );
  }
  return response;
}

/** Read a body, telling how many bytes have come. */
async function readBody(
  response: Response,
  url: string,
  onBytes: (bytes: number) => void,
): Promise<Uint8Array<ArrayBuffer>> {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let loaded = 0;
  try {
    const reader = response.body?.getReader();
    for (let part = await reader?.read(); part?.value !== undefined; part = await reader?.read()) {
      parts.push(part.value);
      loaded += part.value.length;
      onBytes(loaded);
    }
  } catch (error) {
    throw new AppError(
      'download-failed',
      `The download of the model file ${url} broke off after ${loaded} bytes.`,
      'Check the connection, then try again.',
      { cause: error },
    );
  }
  const bytes = new Uint8Array(loaded);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** Undefined when the bytes are what the manifest lists, otherwise what is wrong with them. */
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
 * @throws {AppError} `model-missing`, `download-failed`, or `model-corrupt` when bytes differ from the manifest
 */
export async function download(
  base: string,
  files: readonly ManifestFile[],
  { fetch: get, store, spare = [], onProgress, onUnkept }: DownloadOptions,
): Promise<Uint8Array<ArrayBuffer>[]> {
  const total = files.reduce((sum, file) => sum + file.bytes, 0);
  const found = await lookUp(files, store);
  const kept = found.reduce((sum, bytes) => sum + (bytes?.length ?? 0), 0);
  let loaded = kept;
  const tell = (more: number): void => onProgress?.(Math.min(loaded + more, total), total, kept);
  tell(0);
  let full = false;
  const results: Uint8Array<ArrayBuffer>[] = [];
  for (const [index, file] of files.entries()) {
    const here = found[index];
    if (here !== undefined) {
      results.push(here);
      continue;
    }
    const url = new URL(file.path, base).href;
    const bytes = await readBody(await fetchFile(url, get), url, tell);
    const wrong = await mismatch(bytes, file);
    if (wrong !== undefined) {
      throw new AppError(
        'model-corrupt',
        `The model file ${file.path} is not the one its manifest lists: ${wrong}.`,
        'Load the page again; if it stays so, copy the whole model folder to the server anew.',
      );
    }
    try {
      if (!full) await store?.put(file.sha256, bytes);
    } catch (error) {
      full = true;
      onUnkept?.(error);
    }
    loaded += file.bytes;
    tell(0);
    results.push(bytes);
  }
  await store?.keepOnly([...files.map((file) => file.sha256), ...spare]).catch(() => undefined);
  return results;
}
