import { afterEach, describe, expect, it, vi } from 'vitest';
import { registerServiceWorker } from '../../../web/offline/register';

const SCRIPT = new URL('https://dance.example/studio/service-worker.js');

/** A service worker that has just been installed and waits. */
const installed = (): ServiceWorker =>
  Object.assign(new EventTarget(), { state: 'installed' }) as ServiceWorker;

/**
 * Registers in a browser that installs a build while the page is open, and returns how often an update was offered.
 * As WebKit may do, the new worker controls the page before its installation is reported.
 * @param cachedBefore whether an earlier visit has cached a build
 */
async function visit(cachedBefore: boolean): Promise<number> {
  const coming = installed();
  const workers: Pick<ServiceWorkerRegistration, 'installing'> & { waiting: ServiceWorker | null } = {
    installing: coming,
    waiting: null,
  };
  const registration = Object.assign(new EventTarget(), workers);
  const page: { controller: ServiceWorker | null } = { controller: cachedBefore ? installed() : null };
  const container = Object.assign(new EventTarget(), page, { register: () => Promise.resolve(registration) });
  vi.stubGlobal('navigator', { serviceWorker: container });
  let offers = 0;
  registerServiceWorker(SCRIPT, Promise.resolve(), () => offers++);
  await Promise.resolve();
  await Promise.resolve();
  await Promise.resolve();
  registration.waiting = coming;
  container.controller ??= coming;
  coming.dispatchEvent(new Event('statechange'));
  return offers;
}

describe('registering the service worker', () => {
  afterEach(() => vi.unstubAllGlobals());

  it('offers a newer build than the one that the page was loaded from', async () => {
    expect(await visit(true)).toBe(1);
  });

  it('offers a build that another tab activates before this page has registered', () => {
    const container = Object.assign(new EventTarget(), { controller: installed(), register: vi.fn() });
    vi.stubGlobal('navigator', { serviceWorker: container });
    const onUpdate = vi.fn();
    registerServiceWorker(SCRIPT, new Promise(() => undefined), onUpdate);
    container.controller = installed();
    container.dispatchEvent(new Event('controllerchange'));
    expect(onUpdate).toHaveBeenCalledOnce();
  });

  it('waits for what the page downloads before', async () => {
    const register = vi.fn(() => new Promise(() => undefined));
    vi.stubGlobal('navigator', { serviceWorker: Object.assign(new EventTarget(), { register }) });
    let downloaded = (): void => undefined;
    const before = new Promise<void>((resolve) => (downloaded = resolve));
    registerServiceWorker(SCRIPT, before, () => undefined);
    await new Promise((resolve) => setTimeout(resolve));
    expect(register).not.toHaveBeenCalled();
    downloaded();
    await vi.waitFor(() => expect(register).toHaveBeenCalledOnce());
  });

  it('offers nothing on the first visit, even if the installation is reported late', async () => {
    expect(await visit(false)).toBe(0);
  });
});
