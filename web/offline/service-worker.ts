/** Serves the page from this device. The build writes it anew with the list of its files (tools/vite/service-worker.mjs). */
import { forgetOthers, fromShell, keepShell, type Shell, type ShellScope } from './shell';

declare const self: ServiceWorkerGlobalScope;
/** Put in by the build. */
declare const SHELL: Shell;

const scope: ShellScope = {
  caches: self.caches,
  fetch: (...request) => self.fetch(...request),
  base: self.registration.scope,
};

self.addEventListener('install', (event) => {
  event.waitUntil(keepShell(SHELL, scope));
});

// A new build waits until the pages of the old one are closed, or until one of them asks for it.
self.addEventListener('message', (event) => {
  if (event.data === 'take-over') void self.skipWaiting();
});

self.addEventListener('activate', (event) => {
  event.waitUntil(
    (async () => {
      const windows = await self.clients.matchAll({ type: 'window', includeUncontrolled: true });
      // Other open pages may still need files of the build that they were loaded from.
      if (windows.length <= 1) await forgetOthers(SHELL, scope);
      await self.clients.claim();
    })(),
  );
});

self.addEventListener('fetch', (event) => {
  const { request } = event;
  const kept = fromShell(request, SHELL, scope);
  // What the visitor cleared away comes from the server again.
  if (kept) event.respondWith(kept.then((response) => response ?? self.fetch(request)));
});
