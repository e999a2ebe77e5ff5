/** The model's worker in a real browser, on the processor: numbers, threads, cache, cancelling, crashes, bad servers. */
import { readFileSync } from 'node:fs';
import path from 'node:path';
import type { Page } from '@playwright/test';
import type { Manifest } from '../../../web/model/client';
import type { ExplainedError } from '../support/model-page/main';
import { expect, shipped, test, tinyFolder } from '../support/model-site';

const TINY = { manifestUrl: 'tiny/manifest.json', backend: 'wasm' } as const;
const GRAPHS = 3;

test.beforeEach(async ({ page }) => {
  await page.goto('/');
});

const open = (page: Page, threads?: number) =>
  page.evaluate((options) => model.open(options), { ...TINY, threads });

/** Gives the model so many steps instead of its own: its work takes long enough to be stopped in the middle. */
async function openSlow(page: Page, steps = 50): Promise<void> {
  await page.route('**/tiny/manifest.json', async (route) => {
    const manifest = (await (await route.fetch()).json()) as Manifest;
    await route.fulfill({ json: { ...manifest, diffusion: { ...manifest.diffusion, steps } } });
  });
  await open(page);
}

async function refusal(page: Page): Promise<ExplainedError> {
  const opened = await open(page);
  if (!('error' in opened)) throw new Error('the model was taken');
  return opened.error;
}

/** Counts the graphs that are asked of the server from now on. */
function watchGraphs(page: Page): string[] {
  const asked: string[] = [];
  page.context().on('request', (request) => {
    if (request.url().endsWith('.onnx')) asked.push(request.url());
  });
  return asked;
}

test('a whole sampling in single precision agrees with Python', async ({ page }) => {
  const { error, submissions } = await page.evaluate(() => model.golden('tiny/', 'wasm', 'webgpu'));
  expect(error).toBeLessThan(1e-4);
  expect(submissions).toBe(0);
});

test('a whole sampling with products in 8 bits agrees with Python to a few millimetres', async ({ page }) => {
  const { error, submissions } = await page.evaluate(() => model.golden('tiny/', 'wasm'));
  expect(error).toBeLessThan(3e-3);
  expect(submissions).toBe(0);
});

test('a whole sampling of the shipped model agrees with Python', async ({ page }) => {
  test.skip(!shipped, 'the shipped model is not present');
  const single = await page.evaluate(() => model.golden('salsa/', 'wasm', 'webgpu'));
  expect(single.error).toBeLessThan(1e-3);
  const int8 = await page.evaluate(() => model.golden('salsa/', 'wasm'));
  expect(int8.error).toBeLessThan(0.1);
});

test('a cross-origin isolated page computes on several threads in its worker', async ({ page }) => {
  const threads = 2;
  expect(await open(page, threads)).toMatchObject({ backend: { name: 'wasm', threads } });
  // The model's worker, and onnxruntime's for every further thread.
  expect(page.workers()).toHaveLength(threads);
  await page.evaluate(() => model.readGolden('tiny/golden.npz'));
  const { stages, positions } = await page.evaluate(() => model.generate(250));
  expect([...new Set(stages)]).toEqual(['condition', 'step']);
  expect(positions).toHaveLength(250 * 66);
  expect(positions?.every(Number.isFinite)).toBe(true);
});

test('one core is left for drawing', async ({ page }) => {
  const cores = await page.evaluate(() => navigator.hardwareConcurrency);
  const threads = Math.max(1, Math.min(4, cores - 1));
  expect(await open(page)).toMatchObject({ backend: { name: 'wasm', threads } });
});

test('a page that is not cross-origin isolated computes on one thread', async ({ page }) => {
  await page.route('**/*', async (route) => {
    const response = await route.fetch();
    const headers = response.headers();
    delete headers['cross-origin-opener-policy'];
    delete headers['cross-origin-embedder-policy'];
    await route.fulfill({ response, headers });
  });
  await page.reload();
  expect(await page.evaluate(() => crossOriginIsolated)).toBe(false);
  expect(await open(page)).toMatchObject({ backend: { name: 'wasm', threads: 1 } });
});

test('the processor is chosen where there is only a software adapter, with the reason', async ({ page }) => {
  const opened = await page.evaluate(() => model.open({ manifestUrl: 'tiny/manifest.json' }));
  expect(opened).toMatchObject({
    backend: { name: 'wasm', reason: expect.stringMatching(/WebGPU/) },
  });
});

test('cancelling stops between steps, and the next call works', async ({ page }) => {
  await openSlow(page, 250);
  await page.evaluate(() => model.readGolden('tiny/golden.npz'));
  const cancelled = await page.evaluate(() => model.generate(600, 2));
  expect(cancelled.error?.name).toBe('AbortError');
  // The running step and one more may still be reported; without cancelling there would be a hundred.
  expect(await page.evaluate(() => model.progressInASecond())).toBeLessThanOrEqual(2);
  const next = await page.evaluate(() => model.generate(120));
  expect(next.error).toBeUndefined();
});

test('a crash of the worker is reported, and the next call starts a new worker', async ({ page }) => {
  await openSlow(page);
  await page.evaluate(() => model.readGolden('tiny/golden.npz'));
  const running = page.evaluate(() => model.generate(120));
  await page.waitForFunction(() => model.steps > 1);
  const worker = page.workers().find((candidate) => candidate.url().includes('/worker-'));
  await worker?.evaluate(() => {
    setTimeout(() => {
      throw new Error('the roof fell in');
    });
  });
  const { error } = await running;
  expect(error).toMatchObject({ name: 'AppError', code: 'worker-crashed' });
  expect(error?.message).toContain('the roof fell in');
  const next = await page.evaluate(() => model.generate(120));
  expect(next.positions).toHaveLength(120 * 66);
  // The same numbers as from a worker that never crashed.
  await page.reload();
  await open(page);
  await page.evaluate(() => model.readGolden('tiny/golden.npz'));
  const undisturbed = await page.evaluate(() => model.generate(120));
  expect(next.positions).toEqual(undisturbed.positions);
});

test('graphs are downloaded once, and again when their cached bytes are wrong', async ({ page }) => {
  const asked = watchGraphs(page);
  await open(page);
  expect(asked).toHaveLength(GRAPHS);
  await page.reload();
  await open(page);
  expect(asked).toHaveLength(GRAPHS);
  await page.evaluate(async () => {
    const cache = await caches.open('reactdance-model');
    const first = (await cache.keys()).find(({ url }) => url.includes('/kept-files/'));
    if (first !== undefined) await cache.put(first, new Response('spoiled'));
  });
  await page.reload();
  expect(await open(page)).toMatchObject({ backend: { name: 'wasm' } });
  expect(asked).toHaveLength(GRAPHS + 1);
});

test('a full disk is reported, and the model works', async ({ page, context, modelSite }) => {
  const session = await context.newCDPSession(page);
  const origin = new URL(modelSite).origin;
  await session.send('Storage.overrideQuotaForOrigin', { origin, quotaSize: 1000 });
  expect(await open(page)).toMatchObject({ backend: { name: 'wasm' } });
  const statuses = await page.evaluate(() => model.statuses);
  const notices = statuses.filter(({ kind }) => kind === 'notice');
  expect(notices).toHaveLength(1);
  expect(notices[0]).toMatchObject({
    code: 'not-cached',
    message: expect.stringContaining('QuotaExceededError'),
  });
  await page.evaluate(() => model.readGolden('tiny/golden.npz'));
  const { positions } = await page.evaluate(() => model.generate(40));
  expect(positions).toHaveLength(40 * 66);
});

test.describe('a server', () => {
  test('that answers with a page for the manifest', async ({ page }) => {
    await page.route('**/tiny/manifest.json', (route) =>
      route.fulfill({ contentType: 'text/html', body: '<html>' }),
    );
    expect(await refusal(page)).toMatchObject({ code: 'web-page-instead' });
  });

  test('that answers with a page for a graph', async ({ page }) => {
    await page.route('**/tiny/step-int8.onnx', (route) =>
      route.fulfill({ contentType: 'text/html', body: '<html>' }),
    );
    const error = await refusal(page);
    expect(error.code).toBe('web-page-instead');
    expect(error.message).toContain('step-int8.onnx');
  });

  test('that has no such model', async ({ page }) => {
    await page.route('**/tiny/**', (route) => route.fulfill({ status: 404, body: 'no' }));
    expect(await refusal(page)).toMatchObject({ code: 'model-missing' });
  });

  test('that sends other bytes than the manifest lists', async ({ page }) => {
    const body = readFileSync(path.join(tinyFolder, 'step-int8.onnx'));
    body[body.length - 100] = (body[body.length - 100] ?? 0) ^ 1;
    await page.route('**/tiny/step-int8.onnx', (route) =>
      route.fulfill({ contentType: 'application/octet-stream', body }),
    );
    const error = await refusal(page);
    expect(error.code).toBe('model-corrupt');
    expect(error.message).toContain('SHA-256');
  });

  test('that goes away', async ({ page }) => {
    await page.route('**/tiny/**', (route) => route.abort());
    expect(await refusal(page)).toMatchObject({ code: 'download-failed' });
  });
});
