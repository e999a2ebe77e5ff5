import { describe, expect, it } from 'vitest';
import { fetchLatest } from '../../../../web/model/load/network-first';
import type { ResponseCache } from '../../../../web/model/load/cache';

const URL = 'https://dance.example/models/salsa/manifest.json';
const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);

function store(kept?: string) {
  const files = new Map<string, Uint8Array<ArrayBuffer>>();
  if (kept !== undefined) files.set(URL, new TextEncoder().encode(kept));
  const answers: ResponseCache = {
    get: (key) => Promise.resolve(files.get(key)),
    put: (key, bytes) => Promise.resolve(void files.set(key, bytes)),
  };
  return { answers, files };
}

const offline: typeof fetch = () => Promise.reject(new TypeError('Failed to fetch'));
const status = (code: number) => (): ReturnType<typeof fetch> =>
  Promise.resolve(new Response('', { status: code }));

describe('the latest version of a file', () => {
  it('is fetched from the server, and replaces the stored copy', async () => {
    const { answers, files } = store('old');
    const bytes = await fetchLatest(URL, () => Promise.resolve(new Response('new')), answers);
    expect(text(bytes)).toBe('new');
    expect(text(files.get(URL) ?? new Uint8Array())).toBe('new');
  });

  it.each([
    ['is out of reach', offline],
    ['is broken', status(503)],
  ])('is the stored copy while the server %s', async (_, get) => {
    expect(text(await fetchLatest(URL, get, store('old').answers))).toBe('old');
  });

  it('is the stored copy when the server does not answer in time', async () => {
    const silent: typeof fetch = (_, options) =>
      new Promise((_, reject) => {
        options?.signal?.addEventListener('abort', () => {
          reject(new DOMException('too late', 'TimeoutError'));
        });
      });
    expect(text(await fetchLatest(URL, silent, store('old').answers, 20))).toBe('old');
  });

  it("is the server's when that answers in time, however slowly the file comes", async () => {
    const slow: typeof fetch = (_, options) =>
      Promise.resolve(
        new Response(
          new ReadableStream<Uint8Array>({
            start(body) {
              options?.signal?.addEventListener('abort', () => body.error(options.signal?.reason));
              setTimeout(() => {
                if (options?.signal?.aborted) return;
                body.enqueue(new TextEncoder().encode('new'));
                body.close();
              }, 60);
            },
          }),
        ),
      );
    const { answers, files } = store('old');
    expect(text(await fetchLatest(URL, slow, answers, 20))).toBe('new');
    expect(text(files.get(URL) ?? new Uint8Array())).toBe('new');
  });

  it('is an error when the server answers that there is no such file', async () => {
    await expect(fetchLatest(URL, status(404), store('old').answers)).rejects.toMatchObject({
      code: 'model-missing',
    });
  });

  it('fails without a server and without a copy', async () => {
    await expect(fetchLatest(URL, offline, store().answers)).rejects.toMatchObject({
      code: 'download-failed',
    });
    await expect(fetchLatest(URL, offline)).rejects.toMatchObject({ code: 'download-failed' });
  });

  it('is fetched even when the store fails', async () => {
    const broken: ResponseCache = {
      get: () => Promise.reject(new DOMException('denied', 'SecurityError')),
      put: () => Promise.reject(new DOMException('full', 'QuotaExceededError')),
    };
    expect(text(await fetchLatest(URL, () => Promise.resolve(new Response('new')), broken))).toBe('new');
  });
});
