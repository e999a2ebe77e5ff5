/** The app shell: all files of the page except the runtime and models, which have caches of their own. */
export interface Shell {
  /** Differs between builds. */
  readonly version: string;
  /** Files that are cached at once, by their path from the page's folder, with their `integrity`, as in 'sha256-…'. */
  readonly files: Readonly<Record<string, string>>;
  /** Files that not every visitor needs, in the same form: they are cached when they are used first. */
  readonly onUse: Readonly<Record<string, string>>;
  /** Headers of cross-origin isolation, set on every cached response: without them the page computes on one thread. */
  readonly headers: Readonly<Record<string, string>>;
}

const PREFIX = 'reactdance-shell-';

/** The caches and the fetch that the shell uses; in the page those of the service worker. */
export interface ShellScope {
  readonly caches: CacheStorage;
  readonly fetch: typeof fetch;
  /** Address of the page's folder. */
  readonly base: string;
}

/**
 * How the names of a page's caches begin: pages in several folders of one origin share its caches. The colon, which no
 * encoded folder has, keeps apart those whose folders begin alike.
 */
const prefix = (base: string): string => `${PREFIX}${encodeURIComponent(new URL(base).pathname)}:`;

const cacheName = ({ version }: Shell, { base }: ShellScope): string => prefix(base) + version;

/** The names of all shells of the page in this folder. */
export async function shellNames({ caches, base }: Omit<ShellScope, 'fetch'>): Promise<string[]> {
  const index = new URL('index.html', base).href;
  const names: string[] = [];
  for (const name of await caches.keys()) {
    if (!name.startsWith(PREFIX)) continue;
    // Earlier builds gave no folder: theirs is told by what they hold.
    const isOwn = name.includes(':')
      ? name.startsWith(prefix(base))
      : await caches.match(index, { cacheName: name });
    if (isOwn) names.push(name);
  }
  return names;
}

/**
 * Caches the files of a build, or none: a page with missing files would be worse than no page. Those that are cached on
 * use are among them where the visitor has used them in an older build.
 * @throws when a file can't be fetched, is not the one of this build, or can't be stored
 */
export async function cacheShell(shell: Shell, scope: ShellScope): Promise<void> {
  try {
    const files = { ...shell.files, ...(await usedBefore(shell, scope)) };
    const cache = await scope.caches.open(cacheName(shell, scope));
    // One by one: all together would take every connection from what the visitor waits for.
    for (const [path, integrity] of Object.entries(files)) {
      const address = new URL(path, scope.base).href;
      // The integrity check rejects a file of another build that an HTTP cache still holds.
      const response = await scope.fetch(address, { integrity, cache: 'no-cache' });
      if (!response.ok) throw new Error(`The server answered ${response.status} for ${path}.`);
      await cache.put(address, await storable(response, shell.headers));
    }
  } catch (error) {
    await scope.caches.delete(cacheName(shell, scope)).catch(() => undefined);
    throw error;
  }
}

/** A path without the hash that the build puts into a file's name. */
const withoutHash = (path: string): string => path.replace(/-[\w-]{8}(?=\.\w+$)/, '');

/** The files that are cached on use and were used in an older build, which other caches tell. */
async function usedBefore({ onUse }: Shell, scope: ShellScope): Promise<Shell['files']> {
  const used = new Set<string>();
  for (const name of await shellNames(scope))
    for (const { url } of await (await scope.caches.open(name)).keys())
      used.add(withoutHash(url.slice(scope.base.length)));
  return Object.fromEntries(Object.entries(onUse).filter(([path]) => used.has(withoutHash(path))));
}

/** The response as it is stored: decompressed, with its own length and the headers that the page needs. */
async function storable(response: Response, needed: Shell['headers']): Promise<Response> {
  const body = await response.arrayBuffer();
  const headers = new Headers(response.headers);
  headers.delete('content-encoding');
  // A file depends on nothing in its request, and a cache refuses a response that says it depends on everything.
  headers.delete('vary');
  headers.set('content-length', String(body.byteLength));
  for (const [name, value] of Object.entries(needed)) headers.set(name, value);
  return new Response(body, { headers });
}

/** Deletes the cached shells of other builds. */
export async function deleteOtherShells(shell: Shell, scope: ShellScope): Promise<void> {
  for (const name of await shellNames(scope))
    if (name !== cacheName(shell, scope)) await scope.caches.delete(name);
}

/**
 * The cached response to a request, or null for a request that the shell does not answer.
 * Files in assets/ have a hash of their content in their name, so a page of an older build finds its own files as long
 * as they are cached.
 */
export function matchShell(
  request: Pick<Request, 'url' | 'method' | 'headers'>,
  shell: Shell,
  scope: ShellScope,
): Promise<Response | undefined> | null {
  const { caches, base } = scope;
  if (request.method !== 'GET' || request.headers.has('range')) return null;
  const url = new URL(request.url);
  url.search = url.hash = '';
  if (!url.href.startsWith(base)) return null;
  const path = url.href.slice(base.length) || 'index.html';
  if (Object.hasOwn(shell.files, path))
    return caches.match(new URL(path, base).href, { cacheName: cacheName(shell, scope) });
  if (Object.hasOwn(shell.onUse, path)) return usedNow(path, shell, scope);
  return path.startsWith('assets/') ? caches.match(url.href) : null;
}

/** A file that is cached on use: from the cache, or from the server and then into the cache if there is still one. */
async function usedNow(path: string, shell: Shell, scope: ShellScope): Promise<Response | undefined> {
  const { caches, base } = scope;
  const name = cacheName(shell, scope);
  const address = new URL(path, base).href;
  const cached = await caches.match(address, { cacheName: name });
  // Without a cache the visitor has cleared it, and it stays so.
  if (cached || !(await caches.has(name))) return cached;
  const integrity = shell.onUse[path]!;
  // A server that has another build by now has another file under this name: it is used, but not kept.
  const response = await scope.fetch(address, { integrity, cache: 'no-cache' }).catch(() => null);
  if (!response?.ok) return undefined;
  const stored = await storable(response, shell.headers);
  // A full storage: the file is used all the same.
  await (await caches.open(name)).put(address, stored.clone()).catch(() => undefined);
  return stored;
}
