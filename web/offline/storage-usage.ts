import { ownName } from '../common/own-name';
import { shellNames } from './shell';

/** Bytes that the page has cached on this device, by part. */
export interface StorageUsage {
  readonly page: number;
  readonly runtime: number;
  readonly model: number;
}

/** Adds up the sizes of the page's caches; null where the browser gives the page no storage. */
export async function measureStorage(scope: typeof globalThis): Promise<StorageUsage | null> {
  try {
    const usage = { page: 0, runtime: 0, model: 0 };
    for (const [name, part] of await ownCaches(scope))
      usage[part] += await size(await scope.caches.open(name));
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
  for (const [name] of await ownCaches(scope)) await scope.caches.delete(name);
  const container = scope.navigator.serviceWorker as ServiceWorkerContainer | undefined;
  await (await container?.getRegistration())?.unregister();
}

/** The page's caches by name, with what they hold. */
async function ownCaches({
  caches,
  document,
}: typeof globalThis): Promise<(readonly [string, keyof StorageUsage])[]> {
  const present = await caches.keys();
  const shells = await shellNames({ caches, base: new URL('./', document.baseURI).href });
  return [
    ...shells.map((name) => [name, 'page'] as const),
    ...(['runtime', 'model'] as const)
      .map((part) => [ownName(`reactdance-${part}`, { document }), part] as const)
      .filter(([name]) => present.includes(name)),
  ];
}

/** Size of a cache in bytes, from the content-length of its responses: none has to be read. */
async function size(cache: Cache): Promise<number> {
  const responses = await Promise.all((await cache.keys()).map((request) => cache.match(request)));
  return responses.reduce((sum, response) => sum + Number(response?.headers.get('content-length') ?? 0), 0);
}
