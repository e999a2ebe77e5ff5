import { fetchFile } from './download';
import { AppError } from '../../common/error';
import type { AnswerStore } from './cache';

/** A server that has not begun to answer by then is out of reach, milliseconds; counts only where a copy is kept. */
const PATIENCE = 4000;

/**
 * A file whose newest version counts, as a manifest does, since it names the files that belong together: the server
 * is asked each time, and the copy that was kept last serves only while the server is out of reach.
 * @param patience milliseconds to wait for the server where a copy is kept
 * @throws {AppError} `model-missing` when the server says so; `download-failed` when there is no copy either
 */
export async function fetchLatest(
  url: string,
  get: typeof fetch,
  store?: AnswerStore,
  patience = PATIENCE,
): Promise<Uint8Array<ArrayBuffer>> {
  // A store that fails is as good as an empty one.
  const kept = await store?.get(url).catch(() => undefined);
  const limited: typeof fetch = (address, options) =>
    get(address, kept === undefined ? options : { ...options, signal: AbortSignal.timeout(patience) });
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = await body(await fetchFile(url, limited), url);
  } catch (error) {
    if (kept !== undefined && error instanceof AppError && error.code === 'download-failed') return kept;
    throw error;
  }
  // Full storage is told by the large files, which come next.
  await store?.put(url, bytes).catch(() => undefined);
  return bytes;
}

async function body(response: Response, url: string): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return new Uint8Array(await response.arrayBuffer());
  } catch (error) {
    throw new AppError(
      'download-failed',
      `The download of the model file ${url} broke off.`,
      'Check the connection, then try again.',
      { cause: error },
    );
  }
}
