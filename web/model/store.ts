import type { FileStore } from './download';

const CACHE = 'reactdance-models';

/**
 * One model's files in the Cache API, by SHA-256: a new version of a model never meets the bytes of an old one.
 * @returns undefined where the browser gives the page no storage (insecure origin)
 */
export function cacheStore(scope: typeof globalThis, model: string): FileStore | undefined {
  const caches = scope.caches as CacheStorage | undefined;
  if (caches === undefined) return undefined;
  // Cache keys are addresses; these are never fetched.
  const folder = new URL(`/model-files/${encodeURIComponent(model)}/`, scope.location.origin).href;
  const address = (key: string): string => folder + key;
  return {
    async get(key) {
      const cache = await caches.open(CACHE);
      const response = await cache.match(address(key));
      return response === undefined ? undefined : new Uint8Array(await response.arrayBuffer());
    },
    async put(key, bytes) {
      const cache = await caches.open(CACHE);
      const headers = { 'content-type': 'application/octet-stream' };
      await cache.put(address(key), new Response(bytes, { headers }));
    },
    async keepOnly(keys) {
      const cache = await caches.open(CACHE);
      const kept = new Set(keys.map(address));
      for (const { url } of await cache.keys()) {
        if (url.startsWith(folder) && !kept.has(url)) await cache.delete(url);
      }
    },
  };
}
