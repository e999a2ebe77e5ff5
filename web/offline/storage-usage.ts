/** What the page has kept on this device for the next visit, bytes. */
export interface Kept {
  readonly page: number;
  readonly runtime: number;
  readonly model: number;
}

/** The caches of the page: those of the shell carry its version, the others are named after what they hold. */
const CACHE = /^reactdance-(shell|runtime|model)(-|$)/;

const PARTS = { shell: 'page', runtime: 'runtime', model: 'model' } as const;

/** Adds up what is kept; null where the browser gives the page no storage. */
export async function measureKept(scope: typeof globalThis): Promise<Kept | null> {
  try {
    const kept = { page: 0, runtime: 0, model: 0 };
    for (const name of await scope.caches.keys()) {
      const part = partOf(name);
      if (part) kept[part] += await size(await scope.caches.open(name));
    }
    return kept;
  } catch {
    return null;
  }
}

/**
 * Removes all of it, and the service worker too, so that the next visit begins like the first.
 * What the visitor made is kept elsewhere and stays.
 * @throws when the browser refuses
 */
export async function clearKept(scope: typeof globalThis): Promise<void> {
  for (const name of await scope.caches.keys()) if (partOf(name)) await scope.caches.delete(name);
  const container = scope.navigator.serviceWorker as ServiceWorkerContainer | undefined;
  await (await container?.getRegistration())?.unregister();
}

function partOf(name: string): keyof Kept | null {
  const part = CACHE.exec(name)?.[1];
  return part === undefined ? null : PARTS[part as keyof typeof PARTS];
}

/** Every file is kept with its length, so none has to be read. */
async function size(cache: Cache): Promise<number> {
  const responses = await Promise.all((await cache.keys()).map((request) => cache.match(request)));
  return responses.reduce((sum, response) => sum + Number(response?.headers.get('content-length') ?? 0), 0);
}
