import { describe, expect, it } from 'vitest';
import { fetchLatest } from '../../../../web/model/load/network-first';
import type { ResponseCache } from '../../../../web/model/load/cache';

const URL = 'https://dance.example/models/salsa/manifest.json';
/** Reads a file; one that begins with "bad" is none. */
const text = (bytes: Uint8Array): string => {
  const read = new TextDecoder().decode(bytes);
  if (read.startsWith('bad')) throw new Error(read);
  return read;
};

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
    const read = await fetchLatest(URL, () => Promise.resolve(new Response('new')), text, answers);
    expect(read).toBe('new');
    expect(text(files.get(URL) ?? new Uint8Array())).toBe('new');
  });

  it.each([
    ['is out of reach', offline],
    ['is broken', status(503)],
    [
      'is hidden behind the page of a network that asks to sign in',
      () => Promise.resolve(new Response('<html>', { headers: { 'content-type': 'text/html' } })),
    ],
  ])('is the stored copy while the server %s', async (_, get) => {
    expect(await fetchLatest(URL, get, text, store('old').answers)).toBe('old');
  });

  it('is the stored copy when the server does not answer in time', async () => {
    const silent: typeof fetch = (_, options) =>
      new Promise((_, reject) => {
        options?.signal?.addEventListener('abort', () => {
          reject(new DOMException('too late', 'TimeoutError'));
        });
      });
    expect(await fetchLatest(URL, silent, text, store('old').answers, 20)).toBe('old');
  });

  it('is waited for as long as it takes where there is no copy', async () => {
    const late: typeof fetch = (_, options) =>
      new Promise((resolve, reject) => {
        options?.signal?.addEventListener('abort', () =>
          reject(new DOMException('too late', 'TimeoutError')),
        );
        setTimeout(() => resolve(new Response('new')), 60);
      });
    expect(await fetchLatest(URL, late, text, store().answers, 10)).toBe('new');
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
    expect(await fetchLatest(URL, slow, text, answers, 20)).toBe('new');
    expect(text(files.get(URL) ?? new Uint8Array())).toBe('new');
  });

  it('is an error when the server answers that there is no such file', async () => {
    await expect(fetchLatest(URL, status(404), text, store('old').answers)).rejects.toMatchObject({
      code: 'model-missing',
    });
  });

  it('does not replace the stored copy when it is unreadable', async () => {
    const { answers, files } = store('old');
    const bad = () => Promise.resolve(new Response('bad: quota of the proxy exceeded'));
    await expect(fetchLatest(URL, bad, text, answers)).rejects.toThrow('quota of the proxy');
    expect(text(files.get(URL)!)).toBe('old');
    expect(await fetchLatest(URL, offline, text, answers)).toBe('old');
  });

  it('fails without a server and without a copy', async () => {
    await expect(fetchLatest(URL, offline, text, store().answers)).rejects.toMatchObject({
      code: 'download-failed',
    });
    await expect(fetchLatest(URL, offline, text)).rejects.toMatchObject({ code: 'download-failed' });
  });

  it('is fetched even when the store fails', async () => {
    const broken: ResponseCache = {
      get: () => Promise.reject(new DOMException('denied', 'SecurityError')),
      put: () => Promise.reject(new DOMException('full', 'QuotaExceededError')),
    };
    expect(await fetchLatest(URL, () => Promise.resolve(new Response('new')), text, broken)).toBe('new');
  });
});
