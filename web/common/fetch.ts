import { AppError } from './error';

/** Longest time without a byte before a download is given up, milliseconds. */
const STALL_MS = 30_000;

/**
 * A `fetch` that gives up when nothing arrives for a time, before the response or in the middle of its body: a
 * connection may stay open without a word for ever.
 * @throws {AppError} `download-failed`, from the request or from the body's stream
 */
export function fetchWithTimeout(get: typeof fetch, stallMs = STALL_MS): typeof fetch {
  return async (address, options) => {
    const request = new AbortController();
    let stop = (error: AppError): void => request.abort(error);
    let timer: ReturnType<typeof setTimeout> | undefined;
    const wait = (): void => {
      clearTimeout(timer);
      timer = setTimeout(() => stop(stalled(address, stallMs)), stallMs);
    };
    const watched = new TransformStream<Uint8Array, Uint8Array>({
      start: (body) => {
        stop = (error) => {
          body.error(error);
          request.abort(error);
        };
      },
      transform: (part, body) => {
        wait();
        body.enqueue(part);
      },
      flush: () => clearTimeout(timer),
    });
    wait();
    try {
      const signals = options?.signal ? [options.signal, request.signal] : [request.signal];
      const response = await get(address, { ...options, signal: AbortSignal.any(signals) });
      if (response.body) return new Response(response.body.pipeThrough(watched), response);
      clearTimeout(timer);
      return response;
    } catch (error) {
      clearTimeout(timer);
      throw error;
    }
  };
}

function stalled(address: Parameters<typeof fetch>[0], stallMs: number): AppError {
  const url = address instanceof Request ? address.url : String(address);
  return new AppError(
    'download-failed',
    `Nothing of the file ${url} has arrived for ${stallMs / 1000} seconds.`,
    'Check the connection, then try again.',
  );
}

/**
 * A file that ships with the page.
 * @throws where it does not come; a server of single-page apps answers with a page where a file is missing
 */
export async function fetchShipped(address: URL, signal?: AbortSignal): Promise<Response> {
  const response = await fetchWithTimeout(fetch)(address, { signal: signal ?? null });
  const isPage = response.headers.get('content-type')?.includes('text/html') ?? false;
  if (!response.ok || isPage) throw new Error(`The page has no ${address.pathname} (${response.status}).`);
  return response;
}
