import { ownName } from '../../common/own-name';
import type { FileStore } from './download';

/** Names in the Cache API, one for each part, so that each can be measured and cleared. */
const CACHES = { model: 'reactdance-model', runtime: 'reactdance-runtime' } as const;
export type CachedPart = keyof typeof CACHES;

/** Stores the last response of an address; unlike files by SHA-256 it may be older than the server's. */
export type ResponseCache = Pick<FileStore, 'get' | 'put'>;

/** The browser's storage for the page; undefined where it offers none, as on insecure origins. */
function cacheStorage(scope: typeof globalThis): CacheStorage | undefined {
  try {
    return scope.caches;
  } catch {
    // With blocked storage some browsers throw on access.
    return undefined;
  }
}

function cache(caches: CacheStorage, name: string, address: (key: string) => string): ResponseCache {
  return {
    async get(key) {
      const response = await (await caches.open(name)).match(address(key));
      return response === undefined ? undefined : new Uint8Array(await response.arrayBuffer());
    },
    async put(key, bytes) {
      // The length lets the cache be measured without reading the files.
      const headers = { 'content-type': 'application/octet-stream', 'content-length': String(bytes.length) };
      await (await caches.open(name)).put(address(key), new Response(bytes, { headers }));
    },
  };
}

/**
 * Files in the Cache API, by SHA-256, so that a new version of a model never gets the bytes of an old one.
 * @param owner the model's id; files of other owners in the same part are left alone
 * @returns undefined where the browser gives the page no storage (insecure origin)
 */
export function fileStore(scope: typeof globalThis, part: CachedPart, owner: string): FileStore | undefined {
  const caches = cacheStorage(scope);
  if (caches === undefined) return undefined;
  const name = ownName(CACHES[part], scope);
  // Cache keys are addresses; these are never fetched.
  const folder = new URL(`/kept-files/${encodeURIComponent(owner)}/`, scope.location.origin).href;
  const address = (key: string): string => folder + key;
  return {
    ...cache(caches, name, address),
    async keepOnly(keys) {
      const opened = await caches.open(name);
      const wanted = new Set(keys.map(address));
      for (const { url } of await opened.keys()) {
        if (url.startsWith(folder) && !wanted.has(url)) await opened.delete(url);
      }
    },
  };
}

/** The model's small files, by their own address. */
export function responseCache(scope: typeof globalThis): ResponseCache | undefined {
  const caches = cacheStorage(scope);
  return caches && cache(caches, ownName(CACHES.model, scope), (address) => address);
}
