import { createHash } from 'node:crypto';
import { describe, expect, it } from 'vitest';
import { fetchWithTimeout } from '../../../../web/common/fetch';
import { download, type FileStore } from '../../../../web/model/load/download';
import { AppError } from '../../../../web/common/error';

const BASE = 'https://dance.example/models/salsa/manifest.json';
const bytesOf = (text: string): Uint8Array<ArrayBuffer> => new TextEncoder().encode(text);
const listed = (path: string, text: string) => ({
  path,
  bytes: bytesOf(text).length,
  sha256: createHash('sha256').update(text).digest('hex'),
});

/** A server with these files, and a record of what was asked of it. */
function server(files: Record<string, () => Response>) {
  const asked: string[] = [];
  const get: typeof fetch = (input) => {
    const url = input as string;
    asked.push(url);
    return Promise.resolve(files[url]?.() ?? new Response('not here', { status: 404 }));
  };
  return { get, asked };
}

/** A store in memory; `full` makes it refuse new files as a browser out of space does. */
function memoryStore(full = false) {
  const files = new Map<string, Uint8Array<ArrayBuffer>>();
  const store: FileStore = {
    get: (key) => Promise.resolve(files.get(key)),
    put(key, bytes) {
      if (full) return Promise.reject(new DOMException('no space', 'QuotaExceededError'));
      files.set(key, bytes);
      return Promise.resolve();
    },
    keepOnly(keys) {
      for (const key of files.keys()) if (!keys.includes(key)) files.delete(key);
      return Promise.resolve();
    },
  };
  return { store, files };
}

const a = listed('a.onnx', 'graph a');
const b = listed('b.onnx', 'graph bb');
const both = () =>
  server({
    'https://dance.example/models/salsa/a.onnx': () => new Response('graph a'),
    'https://dance.example/models/salsa/b.onnx': () => new Response('graph bb'),
  });

async function failure(response: () => Response): Promise<AppError> {
  const { get } = server({ 'https://dance.example/models/salsa/a.onnx': response });
  const error: unknown = await download(BASE, [a], { fetch: get }).catch((reason: unknown) => reason);
  if (error instanceof AppError) return error;
  throw new Error('the download was accepted');
}

describe('download', () => {
  it('fetches beside the manifest, reports bytes, and returns the files in order', async () => {
    const progress: [number, number][] = [];
    const files = await download(BASE, [a, b], {
      fetch: both().get,
      onProgress: (loaded, total) => progress.push([loaded, total]),
    });
    expect(files.map((bytes) => new TextDecoder().decode(bytes))).toEqual(['graph a', 'graph bb']);
    expect(progress.at(-1)).toEqual([15, 15]);
    expect(progress.map(([loaded]) => loaded)).toEqual(
      [...progress.map(([loaded]) => loaded)].sort((x, y) => x - y),
    );
  });

  it('fetches nothing that the store has, and deletes files that the model no longer uses', async () => {
    const { store, files } = memoryStore();
    files.set('old', bytesOf('old'));
    await download(BASE, [a, b], { fetch: both().get, store });
    expect([...files.keys()]).toEqual([a.sha256, b.sha256]);
    const again = both();
    const results = await download(BASE, [a, b], { fetch: again.get, store });
    expect(again.asked).toEqual([]);
    expect(results[1]).toEqual(bytesOf('graph bb'));
  });

  it('reports the cached bytes from the start', async () => {
    const { store, files } = memoryStore();
    files.set(b.sha256, bytesOf('graph bb'));
    const progress: [number, number, number][] = [];
    const { get, asked } = both();
    const results = await download(BASE, [a, b], {
      fetch: get,
      store,
      onProgress: (loaded, total, cached) => progress.push([loaded, total, cached]),
    });
    expect(progress[0]).toEqual([8, 15, 8]);
    expect(progress.at(-1)).toEqual([15, 15, 8]);
    expect(asked).toEqual(['https://dance.example/models/salsa/a.onnx']);
    expect(results.map((bytes) => new TextDecoder().decode(bytes))).toEqual(['graph a', 'graph bb']);
  });

  it('fetches nothing before another download has ended, and fails with that', async () => {
    let end = (): void => undefined;
    const after = new Promise<void>((resolve) => (end = resolve));
    const { get, asked } = both();
    const progress: number[] = [];
    const loading = download(BASE, [a], { fetch: get, after, onProgress: (loaded) => progress.push(loaded) });
    await new Promise((resolve) => setTimeout(resolve, 5));
    expect([asked, progress]).toEqual([[], [0]]);
    end();
    expect(await loading).toHaveLength(1);
    const failed = Promise.reject(new Error('the other one'));
    await expect(download(BASE, [a], { fetch: get, after: failed })).rejects.toThrow('the other one');
  });

  it('does not delete files that are to be kept', async () => {
    const { store, files } = memoryStore();
    files.set(b.sha256, bytesOf('graph bb'));
    await download(BASE, [a], { fetch: both().get, store, alsoKeep: [b.sha256] });
    expect([...files.keys()].sort()).toEqual([a.sha256, b.sha256].sort());
  });

  it('fetches a file again whose stored bytes are wrong', async () => {
    const { store, files } = memoryStore();
    files.set(a.sha256, bytesOf('graph A'));
    const { get, asked } = both();
    expect(await download(BASE, [a], { fetch: get, store })).toEqual([bytesOf('graph a')]);
    expect(asked).toHaveLength(1);
    expect(files.get(a.sha256)).toEqual(bytesOf('graph a'));
  });

  it('goes on when the store is full, and reports that once', async () => {
    const reasons: unknown[] = [];
    const files = await download(BASE, [a, b], {
      fetch: both().get,
      store: memoryStore(true).store,
      onCacheFailure: (reason) => reasons.push(reason),
    });
    expect(files).toEqual([bytesOf('graph a'), bytesOf('graph bb')]);
    expect(reasons).toHaveLength(1);
    expect((reasons[0] as DOMException).name).toBe('QuotaExceededError');
  });

  it('reports a web page in place of a model file', async () => {
    const error = await failure(
      () => new Response('<html>', { headers: { 'content-type': 'text/html; charset=utf-8' } }),
    );
    expect(error.code).toBe('web-page-instead');
    expect(error.message).toMatch(/web page .*a\.onnx/);
    expect(error.hint).toContain('sign in');
  });

  it.each<[string, () => Response, string]>([
    ['a missing file', () => new Response('', { status: 404 }), 'model-missing'],
    ['a broken server', () => new Response('', { status: 503 }), 'download-failed'],
    ['other bytes of the same length', () => new Response('graph z'), 'model-corrupt'],
    ['a cut file', () => new Response('graph'), 'model-corrupt'],
    [
      'a connection that breaks',
      () =>
        new Response(new ReadableStream({ pull: (controller) => void controller.error(new Error('reset')) })),
      'download-failed',
    ],
  ])('refuses %s', async (_, response, code) => {
    expect((await failure(response)).code).toBe(code);
  });

  it('reports a missing connection', async () => {
    const get: typeof fetch = () => Promise.reject(new TypeError('Failed to fetch'));
    await expect(download(BASE, [a], { fetch: get })).rejects.toMatchObject({ code: 'download-failed' });
  });
});

describe('a download that breaks off', () => {
  const url = 'https://dance.example/models/salsa/a.onnx';
  /** A server that breaks off after `sent` bytes of the first answer, then answers with `next`; it notes what is asked. */
  function unsteady(
    sent: string,
    next: (range: string | null) => Response,
    headers: Record<string, string> = {},
  ) {
    const ranges: (string | null)[] = [];
    const get: typeof fetch = (_, options) => {
      const range = new Headers(options?.headers).get('range');
      ranges.push(range);
      if (ranges.length > 1) return Promise.resolve(next(range));
      const chunks = [bytesOf(sent)];
      const body = new ReadableStream<Uint8Array>({
        pull: (stream) => {
          const chunk = chunks.shift();
          if (chunk) stream.enqueue(chunk);
          else stream.error(new TypeError('network error'));
        },
      });
      return Promise.resolve(new Response(body, { headers }));
    };
    return { get, ranges };
  }
  async function twice({ get }: { get: typeof fetch }, store = memoryStore().store) {
    const loaded: number[] = [];
    const options = { fetch: get, store, onProgress: (bytes: number) => loaded.push(bytes) };
    await expect(download(BASE, [a], options)).rejects.toMatchObject({
      code: 'download-failed',
      message: `The download of the model file ${url} broke off after 0.0 MB.`,
    });
    loaded.length = 0;
    return { bytes: await download(BASE, [a], options).catch((error: unknown) => error), loaded };
  }
  const rest = () => new Response('h a', { status: 206 });

  it('goes on where it broke off, and leaves nothing behind', async () => {
    const server = unsteady('grap', rest);
    const { store, files } = memoryStore();
    const { bytes, loaded } = await twice(server, store);
    expect(bytes).toEqual([bytesOf('graph a')]);
    expect(server.ranges).toEqual([null, 'bytes=4-']);
    expect(loaded).toEqual([0, 7, 7]);
    expect([...files.keys()]).toEqual([a.sha256]);
  });

  it('begins again where the server sends no parts of files', async () => {
    const { bytes } = await twice(unsteady('grap', () => new Response('graph a')));
    expect(bytes).toEqual([bytesOf('graph a')]);
  });

  it('begins again where the whole is shorter compressed than the rest without', async () => {
    const server = unsteady('gra', () => new Response('graph a'), { 'content-length': '4' });
    await twice(server);
    expect(server.ranges).toEqual([null, null]);
  });

  it('does not go on with a wrong beginning for ever', async () => {
    const server = unsteady('Grap', (range) => (range ? rest() : new Response('graph a')));
    const { store } = memoryStore();
    const { bytes } = await twice(server, store);
    expect(bytes).toMatchObject({ code: 'model-corrupt' });
    expect(await download(BASE, [a], { fetch: server.get, store })).toEqual([bytesOf('graph a')]);
  });
});

describe('a download that stalls', () => {
  const STALL_MS = 40;
  const after = (ms: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, ms));
  /** A server that answers with these parts, each after a wait, and then keeps the connection open. */
  const slow =
    (waits: readonly number[], end: boolean): typeof fetch =>
    () =>
      Promise.resolve(
        new Response(
          new ReadableStream<Uint8Array>({
            async start(body) {
              for (const wait of waits) {
                await after(wait);
                body.enqueue(bytesOf('x'));
              }
              if (end) body.close();
            },
          }),
        ),
      );
  const silent: typeof fetch = (_, options) =>
    new Promise((_resolve, reject) =>
      options?.signal?.addEventListener('abort', () => reject(options.signal?.reason as Error)),
    );

  it.each([
    ['before its response', silent],
    ['in the middle of its body', slow([0, 0], false)],
  ])('%s is given up with a sentence', async (_, get) => {
    const files = [listed('step.onnx', 'xxx')];
    await expect(download(BASE, files, { fetch: fetchWithTimeout(get, STALL_MS) })).rejects.toMatchObject({
      code: 'download-failed',
      message: expect.stringMatching(
        /^Nothing of the file .*step\.onnx has arrived for 0\.04 seconds/,
      ) as string,
    });
  });

  it('is not one that is slow but goes on', async () => {
    const waits = Array.from({ length: 8 }, () => STALL_MS / 4);
    const files = [listed('step.onnx', 'x'.repeat(waits.length))];
    const get = fetchWithTimeout(slow(waits, true), STALL_MS);
    expect((await download(BASE, files, { fetch: get }))[0]).toHaveLength(waits.length);
  });

  it('leaves the signal of the caller in force', async () => {
    const get = fetchWithTimeout(silent, 10_000);
    await expect(get('x', { signal: AbortSignal.timeout(10) })).rejects.toMatchObject({
      name: 'TimeoutError',
    });
  });
});
