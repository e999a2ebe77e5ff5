import { fetchFile } from './download';
import { AppError, type ErrorCode } from '../../common/error';
import type { ResponseCache } from './cache';

/** How long to wait for the server to begin its response, where a stored copy can be used instead. */
const TIMEOUT_MS = 4000;

/** Failures that say nothing of the file: no connection, or a network that asks its user to sign in. */
const OUT_OF_REACH: readonly ErrorCode[] = ['download-failed', 'web-page-instead'];

/**
 * Fetches a file whose newest version is needed, as a manifest's is, which names files that belong together: the
 * server is asked each time, and the last stored copy is used only when it does not respond.
 * @param parse reads the file; one that it refuses, as a proxy's page in its place, never replaces the stored copy
 * @param timeoutMs milliseconds to wait for the server where a copy is stored
 * @throws {AppError} `model-missing` when the server says so; `download-failed` or `web-page-instead` when there is no copy either
 * @throws what `parse` throws
 */
export async function fetchLatest<T>(
  url: string,
  get: typeof fetch,
  parse: (bytes: Uint8Array<ArrayBuffer>) => T,
  store?: ResponseCache,
  timeoutMs = TIMEOUT_MS,
): Promise<T> {
  // A store that fails counts as empty.
  const stored = await store?.get(url).catch(() => undefined);
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = await body(await fetchFile(url, stored === undefined ? get : begunWithin(get, timeoutMs)), url);
  } catch (error) {
    if (stored !== undefined && error instanceof AppError && OUT_OF_REACH.includes(error.code))
      return parse(stored);
    throw error;
  }
  const parsed = parse(bytes);
  // A full storage is reported for the large files, which come next.
  await store?.put(url, bytes).catch(() => undefined);
  return parsed;
}

/** A `fetch` whose response has to begin in time; its body may take longer. */
function begunWithin(get: typeof fetch, timeoutMs: number): typeof fetch {
  return async (address, options) => {
    const request = new AbortController();
    const timer = setTimeout(() => request.abort(), timeoutMs);
    try {
      return await get(address, { ...options, signal: request.signal });
    } finally {
      clearTimeout(timer);
    }
  };
}

async function body(response: Response, url: string): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return new Uint8Array(await response.arrayBuffer());
  } catch (error) {
    if (error instanceof AppError) throw error;
    throw new AppError(
      'download-failed',
      `The download of the model file ${url} broke off.`,
      'Check the connection, then try again.',
      { cause: error },
    );
  }
}
