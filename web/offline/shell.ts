/** The shell: everything that the page is made of but runtime and models, which have caches of their own. */
export interface Shell {
  /** Another build has another one. */
  readonly version: string;
  /** Every file by its path from the page's folder, with its `integrity`, as in 'sha256-…'. */
  readonly files: Readonly<Record<string, string>>;
  /** Headers that the page needs whoever serves it: without them it computes on one thread. */
  readonly headers: Readonly<Record<string, string>>;
}

const PREFIX = 'reactdance-shell-';

/** Where the shell's files come from and go to; in the page it is the service worker's own scope. */
export interface ShellScope {
  readonly caches: CacheStorage;
  readonly fetch: typeof fetch;
  /** Address of the page's folder. */
  readonly base: string;
}

const cacheName = ({ version }: Shell): string => PREFIX + version;

/**
 * Keeps all files of a build, or none: a page with missing pieces would be worse than no page.
 * @throws when a file can't be had, is not the one of this build, or can't be kept
 */
export async function keepShell(shell: Shell, scope: ShellScope): Promise<void> {
  try {
    const cache = await scope.caches.open(cacheName(shell));
    await Promise.all(
      Object.entries(shell.files).map(async ([path, integrity]) => {
        const address = new URL(path, scope.base).href;
        // The integrity refuses a file of another build that a cache on the way still holds.
        const response = await scope.fetch(address, { integrity, cache: 'no-cache' });
        if (!response.ok) throw new Error(`The server answered ${response.status} for ${path}.`);
        await cache.put(address, await complete(response, shell.headers));
      }),
    );
  } catch (error) {
    await scope.caches.delete(cacheName(shell)).catch(() => undefined);
    throw error;
  }
}

/** The response as it is kept: unpacked, with its true length and the headers that the page needs. */
async function complete(response: Response, needed: Shell['headers']): Promise<Response> {
  const body = await response.arrayBuffer();
  const headers = new Headers(response.headers);
  headers.delete('content-encoding');
  headers.set('content-length', String(body.byteLength));
  for (const [name, value] of Object.entries(needed)) headers.set(name, value);
  return new Response(body, { headers });
}

/** Forgets the shells of other builds. */
export async function forgetOthers(shell: Shell, { caches }: ShellScope): Promise<void> {
  for (const name of await caches.keys())
    if (name.startsWith(PREFIX) && name !== cacheName(shell)) await caches.delete(name);
}

/**
 * The kept answer to a request, or null for one that is none of the shell's business.
 * Files in assets/ carry a hash of their content, so a page of an older build gets its own as long as they are kept.
 */
export function fromShell(
  request: Pick<Request, 'url' | 'method' | 'headers'>,
  shell: Shell,
  { caches, base }: ShellScope,
): Promise<Response | undefined> | null {
  if (request.method !== 'GET' || request.headers.has('range')) return null;
  const url = new URL(request.url);
  url.search = url.hash = '';
  if (!url.href.startsWith(base)) return null;
  const path = url.href.slice(base.length) || 'index.html';
  if (Object.hasOwn(shell.files, path))
    return caches.match(new URL(path, base).href, { cacheName: cacheName(shell) });
  return path.startsWith('assets/') ? caches.match(url.href) : null;
}
