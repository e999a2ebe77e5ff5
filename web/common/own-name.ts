/**
 * Names in the browser's storage. It belongs to an origin: pages in other folders of the site, such as a second copy of
 * this one, use the same databases, caches, locks and entries.
 */

/** Address of the page's folder. A worker's script lies in a folder of it: assets/ in the build. */
function pageFolder({ document, location }: Partial<Pick<typeof globalThis, 'document' | 'location'>>): URL {
  return document ? new URL('./', document.baseURI) : new URL('../', location!.href);
}

/** The name with the page's folder, which no other page uses; at the root of a site the name alone. */
export function ownName(
  name: string,
  scope: Partial<Pick<typeof globalThis, 'document' | 'location'>> = globalThis,
): string {
  const { pathname } = pageFolder(scope);
  return pathname === '/' ? name : `${name}:${encodeURIComponent(pathname)}`;
}

/**
 * The page's own entries of localStorage.
 * @throws where the browser forbids storage
 */
export function ownStorage(): Pick<Storage, 'getItem' | 'setItem' | 'removeItem'> {
  const { localStorage } = globalThis;
  return {
    getItem: (key) => localStorage.getItem(ownName(key)),
    setItem: (key, value) => {
      localStorage.setItem(ownName(key), value);
    },
    removeItem: (key) => {
      localStorage.removeItem(ownName(key));
    },
  };
}
