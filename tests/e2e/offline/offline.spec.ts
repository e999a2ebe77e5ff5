/** The page offline: the second visit works without the server, and the visitor can clear the caches. */
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import type { Locator, Page } from '@playwright/test';
import { writeServiceWorker } from '../../../tools/vite/service-worker.mjs';
import { App } from '../support/app-page';
import { bvh, csv } from '../support/files';
import { expect } from '../support/fixtures';
import { test } from '../support/host';

test('no file has a name that GitHub Pages leaves out: without one of them nothing is cached', ({ host }) => {
  const paths = readdirSync(host.root, { recursive: true, encoding: 'utf8' });
  expect(paths.filter((file) => /^[._#]|~$/.test(path.basename(file)))).toEqual([]);
});

/** Waits until the service worker has cached the page. */
async function serviceWorkerReady(page: Page): Promise<void> {
  await page.evaluate(async () => void (await navigator.serviceWorker.ready));
}

async function openCard(page: Page): Promise<Locator> {
  await page.getByRole('banner').getByRole('button', { name: 'Processor' }).click();
  return page.getByRole('dialog', { name: 'On this device' });
}

test('the second visit downloads neither graphs nor runtime, and works without the server', async ({
  page,
  host,
  requests,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await serviceWorkerReady(page);
  const large = (): string[] => requests.filter((address) => /\.(onnx|wasm)$/.test(address));
  expect(large()).toHaveLength(4);

  requests.length = 0;
  await app.openWithoutPicture();
  await app.settled();
  expect(large()).toEqual([]);

  await host.stop();
  try {
    // With the picture this time: all of it has to be here. The scripts that hide WebGL belong to the old tab.
    const tab = await page.context().newPage();
    // Small, for the processor draws it.
    await tab.setViewportSize({ width: 800, height: 480 });
    const offline = new App(tab);
    await offline.open();
    await offline.settled();
    expect(await offline.read(({ model, demo, problem }) => [model.phase, demo, problem])).toEqual([
      'ready',
      'ready',
      null,
    ]);
    // From the cache the page is isolated still, so the model has its threads.
    expect(await tab.evaluate('crossOriginIsolated')).toBe(true);
    expect(await tab.evaluate('window.reactdance.stage !== null')).toBe(true);
    await tab.getByRole('slider', { name: 'Fine guidance' }).fill('1');
    await offline.until(({ reaction, job }) => reaction?.label === null && !job);

    const card = await openCard(tab);
    await expect(card.getByRole('status')).toHaveText(/^\d+\.\d MB kept for offline use$/);
    await card.getByRole('button', { name: 'Clear' }).click();
    await expect(card.getByRole('status')).toHaveText(/^Cleared\./);
    await expect(card.getByText('not kept')).toHaveCount(3);
    await expect(card.getByRole('button', { name: 'Clear' })).toBeDisabled();
    expect(await tab.evaluate(() => caches.keys())).toEqual([]);
  } finally {
    await host.start();
  }
});

test('readers of motion files are downloaded when they are used, and are there offline afterwards', async ({
  page,
  host,
  requests,
}) => {
  // What the service worker fetches is not among the page's requests.
  const readers = (): Promise<string[]> => page.evaluate(cachedReaders);
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await serviceWorkerReady(page);
  await app.chooseLeader(bvh({ frames: 60, name: 'mine.bvh' }));
  await app.until(({ leader }) => leader?.name === 'mine.bvh');
  expect(await readers()).toEqual([]);
  expect(requests.filter((address) => address.includes('/reader-'))).toEqual([]);

  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(csv(60));
  await app.until(({ leader, problem }) => leader?.name === 'table.csv' || problem);
  expect(await app.read(({ problem }) => problem)).toBeNull();
  // Of the others it may share parts, but a reader of another format is not downloaded.
  const others = /^reader-(amc|c3d|fbx|gltf|numpy|tables-json|tables-trc|vmd)$/;
  expect(await readers()).toContain('reader-tables-csv');
  expect((await readers()).filter((name) => others.test(name))).toEqual([]);

  await host.stop();
  try {
    await app.chooseLeader(bvh({ frames: 50, name: 'between.bvh' }));
    await app.until(({ leader }) => leader?.name === 'between.bvh');
    await app.chooseLeader(csv(60));
    await app.until(({ leader }) => leader?.name === 'table.csv');
    await app.chooseLeader({
      name: 'a.c3d',
      mimeType: '',
      buffer: Buffer.from([2, 0x50, ...Buffer.alloc(510)]),
    });
    await expect(app.alert).toHaveAttribute('data-code', 'page-part-missing');
    expect(await app.read(({ leader }) => leader?.name)).toBe('table.csv');
  } finally {
    await host.start();
  }
});

/** Runs in the page: the readers that are cached, without the hashes of their names. */
async function cachedReaders(): Promise<string[]> {
  const found: string[] = [];
  for (const name of await caches.keys())
    for (const { url } of await (await caches.open(name)).keys())
      found.push(...[/reader-[a-z-]+(?=-[\w-]{8}\.js$)/.exec(url)?.[0] ?? []].flat());
  return found;
}

test('a browser without storage generates all the same, and the page says so', async ({ page, site }) => {
  const session = await page.context().newCDPSession(page);
  const origin = new URL(site).origin;
  await session.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: 1000 });
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await page.getByRole('slider', { name: 'Fine guidance' }).fill('1');
  await app.until(({ reaction, job }) => reaction?.label === null && !job);
  await expect(page.getByRole('list', { name: 'Notes' })).toContainText('could not keep the model');
  const card = await openCard(page);
  await expect(card.getByRole('status')).toHaveText('Nothing is kept for offline use.');
});

test('a new build is offered in every tab, and then loaded completely', async ({ page, host }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await serviceWorkerReady(page);
  const file = path.join(host.root, 'index.html');
  const before = readFileSync(file, 'utf8');
  const update = async (name: string, ...tabs: Page[]): Promise<void> => {
    writeFileSync(file, before.replace('<title>', `<meta name="build" content="${name}" /><title>`));
    await writeServiceWorker(host.root);
    for (const tab of tabs) await new App(tab).openWithoutPicture();
    for (const tab of tabs) {
      const next = tab.locator(`meta[name="build"][content="${name}"]`);
      await expect(next).not.toBeAttached();
      const note = tab.getByRole('status').filter({ hasText: 'A new version is ready.' });
      await note.getByRole('button', { name: 'Reload' }).click();
      await expect(next).toBeAttached();
    }
  };
  const other = await page.context().newPage();
  await update('next', page, other);
  await other.close();
  // What two tabs left of the first build goes with the second one.
  await update('last', page);
  await expect.poll(() => page.evaluate(shells)).toHaveLength(1);
});

/** Runs in the page: the caches that hold a build. */
async function shells(): Promise<string[]> {
  return (await caches.keys()).filter((name) => name.startsWith('reactdance-shell-'));
}
