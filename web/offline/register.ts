/** The page's side of its service worker. */
export interface OfflinePage {
  /** Takes the new build that is waiting and loads the page from it. */
  readonly takeUpdate: () => void;
}

/**
 * Keeps the page for visits without a connection. Where the browser can't or won't, the page works from the network
 * as before, so nothing is told.
 * @param script address of the service worker
 * @param onUpdate called when a newer build is here and waits to be taken
 */
export function keepPage(script: URL, onUpdate: () => void): OfflinePage {
  let waiting: ServiceWorker | null = null;
  const container = navigator.serviceWorker as ServiceWorkerContainer | undefined;
  // A page that came from the server is what will be kept first: nothing newer waits for it. Asked now, for WebKit
  // may tell that a worker was installed only when that one has already taken the page over.
  const wasKept = Boolean(container?.controller);

  const offer = (worker: ServiceWorker | null): void => {
    if (!worker || !wasKept) return;
    waiting = worker;
    onUpdate();
  };
  const register = async (): Promise<void> => {
    try {
      // Asked of the server each time: a host that lets scripts be cached would hide new builds.
      const registration = await container?.register(script, { updateViaCache: 'none' });
      if (!registration) return;
      offer(registration.waiting);
      const follow = (coming: ServiceWorker | null): void => {
        coming?.addEventListener('statechange', () => {
          if (coming.state === 'installed') offer(registration.waiting);
        });
      };
      follow(registration.installing);
      registration.addEventListener('updatefound', () => {
        follow(registration.installing);
      });
    } catch {
      // Forbidden, out of space, or a build that is just being replaced on the server.
    }
  };
  // What the page itself needs comes first.
  if (document.readyState === 'complete') void register();
  else addEventListener('load', () => void register(), { once: true });

  return {
    takeUpdate: () => {
      if (!waiting) return;
      container?.addEventListener(
        'controllerchange',
        () => {
          location.reload();
        },
        { once: true },
      );
      waiting.postMessage('take-over');
    },
  };
}
