import { describe, expect, it } from 'vitest';
import {
  deleteOtherShells,
  matchShell,
  cacheShell,
  type Shell,
  type ShellScope,
} from '../../../web/offline/shell';

const BASE = 'https://dance.example/studio/';

/** A CacheStorage in memory with the methods that the shell uses. @param room files that fit into a cache */
function memoryCaches(room = Infinity) {
  const all = new Map<string, Map<string, Response>>();
  const caches = {
    open: (name: string) => {
      const files = all.get(name) ?? new Map<string, Response>();
      all.set(name, files);
      return Promise.resolve({
        put: (address: string, response: Response) => {
          if (response.headers.get('vary') === '*') return Promise.reject(new TypeError('Vary: *'));
          if (files.size >= room) return Promise.reject(new DOMException('full', 'QuotaExceededError'));
          return Promise.resolve(void files.set(address, response));
        },
        keys: () => Promise.resolve([...files.keys()].map((url) => ({ url }))),
      });
    },
    match: (address: string, { cacheName }: { cacheName?: string } = {}) =>
      Promise.resolve(
        [...all]
          .filter(([name]) => cacheName === undefined || name === cacheName)
          .map(([, files]) => files.get(address)?.clone())
          .find((response) => response !== undefined),
      ),
    has: (name: string) => Promise.resolve(all.has(name)),
    keys: () => Promise.resolve([...all.keys()]),
    delete: (name: string) => Promise.resolve(all.delete(name)),
  };
  return { all, caches: caches as unknown as CacheStorage };
}

const HASHES: Readonly<Record<string, string>> = { one: 'AbC_dE-1', two: 'xYz01234' };

const shell = (version: string): Shell => ({
  version,
  files: { 'index.html': 'sha256-a', [`assets/main-${version}.js`]: 'sha256-b' },
  onUse: { [`assets/reader-fbx-${HASHES[version]}.js`]: 'sha256-c', 'leaders/slow.bvh': 'sha256-d' },
  headers: { 'Cross-Origin-Embedder-Policy': 'require-corp' },
});

const server =
  (build: string, headers: Readonly<Record<string, string>> = {}): typeof fetch =>
  (address) =>
    Promise.resolve(
      new Response(`${build} ${address as string}`, {
        headers: {
          'content-encoding': 'br',
          'content-length': '3',
          'content-security-policy': "default-src 'self'",
          ...headers,
        },
      }),
    );

async function cached(
  build = 'one',
  memory = memoryCaches(),
  headers: Readonly<Record<string, string>> = {},
) {
  const scope: ShellScope = { caches: memory.caches, fetch: server(build, headers), base: BASE };
  await cacheShell(shell(build), scope);
  const ask = (path: string, request: Partial<Request> = {}) =>
    matchShell({ url: BASE + path, method: 'GET', headers: new Headers(), ...request }, shell(build), scope);
  return { ...memory, scope, ask };
}

describe('the cached app shell', () => {
  it('answers with the cached file, whatever query or fragment the address has', async () => {
    const { ask } = await cached();
    for (const path of ['', 'index.html', '?model=mine/manifest.json', '#top'])
      expect(await (await ask(path))?.text()).toMatch(/^one/);
    expect(await (await ask('assets/main-one.js'))?.text()).toContain('main-one.js');
  });

  it('adds the headers of cross-origin isolation and keeps the server’s own, except those of the compression', async () => {
    const { ask } = await cached();
    const response = await ask('');
    expect(response?.headers.get('cross-origin-embedder-policy')).toBe('require-corp');
    expect(response?.headers.get('content-security-policy')).toBe("default-src 'self'");
    expect(response?.headers.get('content-encoding')).toBeNull();
    expect(Number(response?.headers.get('content-length'))).toBe((await response?.text())?.length);
  });

  it('caches what a server sends with Vary: *', async () => {
    const { ask } = await cached('one', memoryCaches(), { vary: '*' });
    expect(await (await ask(''))?.text()).toMatch(/^one/);
  });

  it('leaves models, parts of files and other sites to the network', async () => {
    const { ask } = await cached();
    expect(ask('models/salsa/step.onnx')).toBeNull();
    expect(ask('index.html', { headers: new Headers({ range: 'bytes=0-9' }) })).toBeNull();
    expect(ask('', { method: 'POST' })).toBeNull();
    expect(ask('', { url: 'https://elsewhere.example/index.html' })).toBeNull();
  });

  it('serves a page of an older build its own files until they are deleted', async () => {
    const older = await cached('one');
    const newer = await cached('two', older);
    expect(await (await newer.ask(''))?.text()).toMatch(/^two/);
    expect(await (await newer.ask('assets/main-one.js'))?.text()).toMatch(/^one/);
    await deleteOtherShells(shell('two'), newer.scope);
    expect(await newer.ask('assets/main-one.js')).toBeUndefined();
    expect(await (await newer.ask(''))?.text()).toMatch(/^two/);
  });

  describe('files that not everybody needs', () => {
    const FBX = 'assets/reader-fbx-AbC_dE-1.js';
    const names = ({ all }: { all: ReadonlyMap<string, ReadonlyMap<string, unknown>> }, build: string) =>
      [...all.get(`reactdance-shell-${build}`)!.keys()].map((address) => address.slice(BASE.length));

    it('are fetched when they are used, once', async () => {
      const own = await cached();
      expect(names(own, 'one')).toEqual(['index.html', 'assets/main-one.js']);
      const fetched: string[] = [];
      const scope: ShellScope = {
        ...own.scope,
        fetch: (address, options) => {
          fetched.push(`${address as string} ${options!.integrity!}`);
          return server('one')(address, options);
        },
      };
      const ask = () =>
        matchShell({ url: BASE + FBX, method: 'GET', headers: new Headers() }, shell('one'), scope);
      for (let use = 0; use < 2; use++) {
        const response = await ask();
        expect(await response?.text()).toContain('reader-fbx');
        expect(response?.headers.get('cross-origin-embedder-policy')).toBe('require-corp');
      }
      expect(fetched).toEqual([`${BASE}${FBX} sha256-c`]);
      expect(names(own, 'one')).toContain(FBX);
    });

    it('come with the next build where they were used before, and only then', async () => {
      const older = await cached('one');
      await older.ask(FBX);
      const newer = await cached('two', older);
      expect(names(newer, 'two')).toEqual(
        expect.arrayContaining(['assets/main-two.js', 'assets/reader-fbx-xYz01234.js']),
      );
      expect(names(newer, 'two')).not.toContain('leaders/slow.bvh');
    });

    it.each([
      ['has another file by now', () => Promise.reject(new TypeError('integrity'))],
      ['has it no longer', () => Promise.resolve(new Response('', { status: 404 }))],
    ])('are left to the network where the server %s', async (_, fetch) => {
      const own = await cached();
      const scope: ShellScope = { ...own.scope, fetch };
      const request = { url: `${BASE}leaders/slow.bvh`, method: 'GET', headers: new Headers() };
      expect(await matchShell(request, shell('one'), scope)).toBeUndefined();
      expect(names(own, 'one')).not.toContain('leaders/slow.bvh');
    });

    it('are not cached after the visitor has cleared the cache, and are used where it is full', async () => {
      const cleared = await cached();
      cleared.all.clear();
      expect(await cleared.ask(FBX)).toBeUndefined();
      expect(cleared.all.size).toBe(0);
      const full = await cached('one', memoryCaches(2));
      expect(await (await full.ask(FBX))?.text()).toContain('reader-fbx');
    });
  });

  it('is cached completely or not at all', async () => {
    const full = memoryCaches(1);
    await expect(cached('one', full)).rejects.toThrow('full');
    expect(full.all.size).toBe(0);
    const incomplete = memoryCaches();
    const missing: typeof fetch = (address, options) =>
      (address as string).endsWith('.js')
        ? Promise.resolve(new Response('', { status: 404 }))
        : server('one')(address, options);
    await expect(
      cacheShell(shell('one'), { caches: incomplete.caches, fetch: missing, base: BASE }),
    ).rejects.toThrow('404');
    expect(incomplete.all.size).toBe(0);
  });

  it('answers with nothing after the visitor has cleared the cache', async () => {
    const { ask, all } = await cached();
    all.clear();
    expect(await ask('')).toBeUndefined();
  });
});
