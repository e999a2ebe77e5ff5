import type { FileStore } from './download';

/** What the page keeps on this device, each in a cache of its own that can be measured and emptied. */
const CACHES = { model: 'reactdance-model', runtime: 'reactdance-runtime' } as const;
export type KeptPart = keyof typeof CACHES;

/** Keeps the last answer of an address; unlike files by SHA-256 it may be older than the server's. */
export type AnswerStore = Pick<FileStore, 'get' | 'put'>;

/** The browser's storage for the page; undefined where it offers none, as on insecure origins. */
function openable(scope: typeof globalThis): CacheStorage | undefined {
  try {
    return scope.caches;
  } catch {
    // Blocked storage: some browsers refuse even to name it.
    return undefined;
  }
}

function cache(caches: CacheStorage, part: KeptPart, address: (key: string) => string): AnswerStore {
  return {
    async get(key) {
      const response = await (await caches.open(CACHES[part])).match(address(key));
      return response === undefined ? undefined : new Uint8Array(await response.arrayBuffer());
    },
    async put(key, bytes) {
      // The length tells how much is kept without reading it all.
      const headers = { 'content-type': 'application/octet-stream', 'content-length': String(bytes.length) };
      await (await caches.open(CACHES[part])).put(address(key), new Response(bytes, { headers }));
    },
  };
}

/**
 * Files in the Cache API, by SHA-256: a new version of a model never meets the bytes of an old one.
 * @param owner the model's id; files of other owners in the same part are left alone
 * @returns undefined where the browser gives the page no storage (insecure origin)
 */
export function fileStore(scope: typeof globalThis, part: KeptPart, owner: string): FileStore | undefined {
  const caches = openable(scope);
  if (caches === undefined) return undefined;
  // Cache keys are addresses; these are never fetched.
  const folder = new URL(`/kept-files/${encodeURIComponent(owner)}/`, scope.location.origin).href;
  const address = (key: string): string => folder + key;
  return {
    ...cache(caches, part, address),
    async keepOnly(keys) {
      const opened = await caches.open(CACHES[part]);
      const kept = new Set(keys.map(address));
      for (const { url } of await opened.keys()) {
        if (url.startsWith(folder) && !kept.has(url)) await opened.delete(url);
      }
    },
  };
}

/** The model's small files, by their own address. */
export function answerStore(scope: typeof globalThis): AnswerStore | undefined {
  const caches = openable(scope);
  return caches && cache(caches, 'model', (address) => address);
}
