/** Bytes that the page has cached on this device, by part. */
export interface StorageUsage {
  readonly page: number;
  readonly runtime: number;
  readonly model: number;
}

/** Names of the page's caches; that of the shell ends in its version. */
const CACHE_NAME = /^reactdance-(shell|runtime|model)(-|$)/;

const PARTS = { shell: 'page', runtime: 'runtime', model: 'model' } as const;

/** Adds up the sizes of the page's caches; null where the browser gives the page no storage. */
export async function measureStorage(scope: typeof globalThis): Promise<StorageUsage | null> {
  try {
    const usage = { page: 0, runtime: 0, model: 0 };
    for (const name of await scope.caches.keys()) {
      const part = partOf(name);
      if (part) usage[part] += await size(await scope.caches.open(name));
    }
    return usage;
  } catch {
    return null;
  }
}

/**
 * Deletes the page's caches and unregisters its service worker, so that the next visit begins like the first.
 * The visitor's own songs, leaders and takes are in a database (ui/project/storage.ts) and stay.
 * @throws when the browser refuses
 */
export async function clearStorage(scope: typeof globalThis): Promise<void> {
  for (const name of await scope.caches.keys()) if (partOf(name)) await scope.caches.delete(name);
  const container = scope.navigator.serviceWorker as ServiceWorkerContainer | undefined;
  await (await container?.getRegistration())?.unregister();
}

function partOf(name: string): keyof StorageUsage | null {
  const part = CACHE_NAME.exec(name)?.[1];
  return part === undefined ? null : PARTS[part as keyof typeof PARTS];
}

/** Size of a cache in bytes, from the content-length of its responses: none has to be read. */
async function size(cache: Cache): Promise<number> {
  const responses = await Promise.all((await cache.keys()).map((request) => cache.match(request)));
  return responses.reduce((sum, response) => sum + Number(response?.headers.get('content-length') ?? 0), 0);
}
