import { afterEach, describe, expect, it, vi } from 'vitest';
import { keepPage } from '../../../web/offline/register';

const SCRIPT = new URL('https://dance.example/studio/service-worker.js');

/** A worker as it looks when it has just been installed and waits. */
const installed = (): ServiceWorker =>
  Object.assign(new EventTarget(), { state: 'installed' }) as ServiceWorker;

/**
 * A browser that has kept a build before, or has not, and installs one while the page is open. Like WebKit at its
 * busiest, it lets the new worker take the page over before it tells of its installation.
 */
async function visit(keptBefore: boolean): Promise<number> {
  const coming = installed();
  const workers: Pick<ServiceWorkerRegistration, 'installing'> & { waiting: ServiceWorker | null } = {
    installing: coming,
    waiting: null,
  };
  const registration = Object.assign(new EventTarget(), workers);
  const page: { controller: ServiceWorker | null } = { controller: keptBefore ? installed() : null };
  const container = Object.assign(new EventTarget(), page, { register: () => Promise.resolve(registration) });
  vi.stubGlobal('navigator', { serviceWorker: container });
  vi.stubGlobal('document', { readyState: 'complete' });
  let offers = 0;
  keepPage(SCRIPT, () => offers++);
  await Promise.resolve();
  await Promise.resolve();
  registration.waiting = coming;
  container.controller ??= coming;
  coming.dispatchEvent(new Event('statechange'));
  return offers;
}

describe('keeping the page for the next visit', () => {
  afterEach(() => vi.unstubAllGlobals());

  it('offers a build that came after the one that the page was loaded from', async () => {
    expect(await visit(true)).toBe(1);
  });

  it('offers nothing on the first visit, whenever the browser tells that the page was kept', async () => {
    expect(await visit(false)).toBe(0);
  });
});
