/** A CacheStorage in memory with the methods that the page uses on it. @param room files that fit into a cache */
export function memoryCaches(room = Infinity) {
  const all = new Map<string, Map<string, Response>>();
  const caches = {
    open: (name: string) => {
      const files = all.get(name) ?? new Map<string, Response>();
      all.set(name, files);
      return Promise.resolve({
        put: (address: string, response: Response) => {
          if (response.headers.get('vary') === '*') return Promise.reject(new TypeError('Vary: *'));
          if (files.size >= room) return Promise.reject(new DOMException('full', 'QuotaExceededError'));
          return Promise.resolve(void files.set(address, response));
        },
        keys: () => Promise.resolve([...files.keys()].map((url) => ({ url }))),
        match: (asked: string | { url: string }) =>
          Promise.resolve(files.get(typeof asked === 'string' ? asked : asked.url)?.clone()),
        delete: (address: string) => Promise.resolve(files.delete(address)),
      });
    },
    match: (address: string, { cacheName }: { cacheName?: string } = {}) =>
      Promise.resolve(
        [...all]
          .filter(([name]) => cacheName === undefined || name === cacheName)
          .map(([, files]) => files.get(address)?.clone())
          .find((response) => response !== undefined),
      ),
    has: (name: string) => Promise.resolve(all.has(name)),
    keys: () => Promise.resolve([...all.keys()]),
    delete: (name: string) => Promise.resolve(all.delete(name)),
  };
  return { all, caches: caches as unknown as CacheStorage };
}
