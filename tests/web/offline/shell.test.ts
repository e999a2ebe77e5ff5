import { describe, expect, it } from 'vitest';
import {
  deleteOtherShells,
  matchShell,
  cacheShell,
  type Shell,
  type ShellScope,
} from '../../../web/offline/shell';
import { clearStorage, measureStorage } from '../../../web/offline/storage-usage';
import { memoryCaches } from '../support/memory-caches';

const BASE = 'https://dance.example/studio/';

/** The cache of a build of the page in a folder. */
const name = (build: string, folder = '/studio/'): string =>
  `reactdance-shell-${encodeURIComponent(folder)}:${build}`;

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
  { headers, base = BASE }: { headers?: Readonly<Record<string, string>>; base?: string } = {},
) {
  const scope: ShellScope = { caches: memory.caches, fetch: server(build, headers), base };
  await cacheShell(shell(build), scope);
  const ask = (path: string, request: Partial<Request> = {}) =>
    matchShell({ url: base + path, method: 'GET', headers: new Headers(), ...request }, shell(build), scope);
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
    const { ask } = await cached('one', memoryCaches(), { headers: { vary: '*' } });
    expect(await (await ask(''))?.text()).toMatch(/^one/);
  });

  it('is fetched file by file, so that connections are left to the page', async () => {
    let [open, most] = [0, 0];
    const one = server('one');
    const fetch: typeof one = async (...request) => {
      most = Math.max(most, ++open);
      await new Promise((resolve) => setTimeout(resolve));
      open--;
      return one(...request);
    };
    await cacheShell(shell('one'), { caches: memoryCaches().caches, fetch, base: BASE });
    expect(most).toBe(1);
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
      [...all.get(name(build))!.keys()].map((address) => address.slice(BASE.length));

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

  describe('beside pages in other folders of the same origin', () => {
    // The names of the last two begin like that of the page's own folder.
    const others = ['https://dance.example/', `${BASE}old/`, 'https://dance.example/studio-2/'];

    it('deletes only its own older builds', async () => {
      const memory = memoryCaches();
      for (const base of others) await cached('one', memory, { base });
      await cached('one', memory);
      const { scope, ask } = await cached('two', memory);
      await deleteOtherShells(shell('two'), scope);
      const kept = others.map((base) => name('one', new URL(base).pathname));
      expect([...memory.all.keys()]).toEqual([...kept, name('two')]);
      expect(await (await ask(''))?.text()).toBe(`two ${BASE}index.html`);
    });

    it('is cleared alone, and its runtime and model with it', async () => {
      const memory = memoryCaches();
      await cached('one', memory);
      for (const base of others) await cached('one', memory, { base });
      for (const name of ['reactdance-model:%2Fstudio%2F', 'reactdance-model', 'of another page'])
        await (
          await memory.caches.open(name)
        ).put(`${BASE}x`, new Response('', { headers: { 'content-length': '5' } }));
      const page = { caches: memory.caches, document: { baseURI: `${BASE}index.html?study` }, navigator: {} };
      const scope = page as unknown as typeof globalThis;
      const files = [...memory.all.get(name('one'))!.values()];
      const bytes = files.reduce((sum, { headers }) => sum + Number(headers.get('content-length')), 0);
      expect(await measureStorage(scope)).toEqual({ page: bytes, runtime: 0, model: 5 });
      await clearStorage(scope);
      expect([...memory.all.keys()]).toEqual([
        ...others.map((base) => name('one', new URL(base).pathname)),
        'reactdance-model',
        'of another page',
      ]);
    });

    it('takes over and deletes what earlier builds cached under a name without a folder', async () => {
      const memory = memoryCaches();
      const rename = (build: string, base: string): void => {
        const now = name(build, new URL(base).pathname);
        memory.all.set(`reactdance-shell-${build}`, memory.all.get(now)!);
        memory.all.delete(now);
      };
      const own = await cached('one', memory);
      await own.ask('leaders/slow.bvh');
      rename('one', BASE);
      await cached('other', memory, { base: others[0]! });
      rename('other', others[0]!);
      const { scope } = await cached('two', memory);
      expect([...memory.all.get(name('two'))!.keys()]).toContain(`${BASE}leaders/slow.bvh`);
      await deleteOtherShells(shell('two'), scope);
      expect([...memory.all.keys()]).toEqual(['reactdance-shell-other', name('two')]);
    });
  });
});
