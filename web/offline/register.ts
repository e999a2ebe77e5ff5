/** How a newer build, which the service worker has cached, comes to be used. */
interface ServiceWorkerUpdates {
  /** Activates the newer build and reloads the page from it. */
  readonly activateUpdate: () => void;
}

/**
 * Registers the service worker, which caches the page for use offline. Where the browser has none or refuses it, the
 * page is loaded from the network as before, and no failure is reported.
 * @param script address of the service worker
 * @param after what is downloaded before the files that it caches
 * @param onUpdate called when a newer build is cached and waits to be activated
 */
export function registerServiceWorker(
  script: URL,
  after: Promise<void>,
  onUpdate: () => void,
): ServiceWorkerUpdates {
  let waiting: ServiceWorker | null = null;
  const container = navigator.serviceWorker as ServiceWorkerContainer | undefined;
  // A page without a controlling service worker came from the server, so no newer build waits. This is read now because
  // WebKit may report an installed worker only after that worker controls the page.
  const wasControlled = Boolean(container?.controller);

  let isActivating = false;
  const offer = (worker: ServiceWorker | null): void => {
    if (!worker || !wasControlled) return;
    waiting = worker;
    onUpdate();
  };
  container?.addEventListener('controllerchange', () => {
    if (isActivating) location.reload();
    // Another tab has activated a newer build than this page's, perhaps before this page registered.
    else offer(container.controller);
  });
  const register = async (): Promise<void> => {
    try {
      // The script is fetched from the server each time: a host that lets scripts be cached would hide new builds.
      const registration = await container?.register(script, { updateViaCache: 'none' });
      if (!registration) return;
      offer(registration.waiting);
      const offerWhenInstalled = (worker: ServiceWorker | null): void => {
        worker?.addEventListener('statechange', () => {
          if (worker.state === 'installed') offer(registration.waiting);
        });
      };
      offerWhenInstalled(registration.installing);
      registration.addEventListener('updatefound', () => {
        offerWhenInstalled(registration.installing);
      });
    } catch {
      // Registering is forbidden, storage is full, or the build is just being replaced on the server.
    }
  };
  void after.then(register);

  return {
    activateUpdate: () => {
      if (!waiting) return;
      // Another tab has activated it already: it controls this page too, and no event will come.
      if (waiting.state !== 'installed') return location.reload();
      isActivating = true;
      waiting.postMessage('take-over');
    },
  };
}
