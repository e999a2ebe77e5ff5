/** The service worker: serves the page from its cache. The build adds the list of files (tools/vite/service-worker.mjs). */
import { deleteOtherShells, matchShell, cacheShell, type Shell, type ShellScope } from './shell';

declare const self: ServiceWorkerGlobalScope;
/** Defined by the build. */
declare const SHELL: Shell;

const scope: ShellScope = {
  caches: self.caches,
  fetch: (...request) => self.fetch(...request),
  base: self.registration.scope,
};

self.addEventListener('install', (event) => {
  event.waitUntil(cacheShell(SHELL, scope));
});

// A newer build waits until all pages of the older one are closed, or until one of them activates it.
self.addEventListener('message', (event) => {
  if (event.data === 'take-over') void self.skipWaiting();
});

self.addEventListener('activate', (event) => {
  event.waitUntil(
    (async () => {
      const windows = await self.clients.matchAll({ type: 'window', includeUncontrolled: true });
      await self.clients.claim();
      // Other open pages may still need files of the build that they were loaded from.
      if (windows.length <= 1) await deleteOtherShells(SHELL, scope);
    })(),
  );
});

self.addEventListener('fetch', (event) => {
  const { request } = event;
  const cached = matchShell(request, SHELL, scope);
  // After the visitor has cleared the cache, files come from the server again.
  if (cached) event.respondWith(cached.then((response) => response ?? self.fetch(request)));
});
