/** The model on WebGPU, on the software adapter: slow, but the same shaders and the same code as on a graphics card. */
import { createHash } from 'node:crypto';
import { zipSync } from 'fflate';
import type { Manifest } from '../../../web/model/manifest';
import { expect, test } from '../support/model-site';

test.describe.configure({ timeout: 600_000 });

test.beforeEach(async ({ page }) => {
  await page.goto('/');
});

test('numbers that differ from the reference move the work to the processor, with the reason', async ({
  page,
}) => {
  // A reference of two latent frames in which the partner is at the origin with all joints.
  const npy = (name: string, shape: number[], value: (i: number) => number): [string, Uint8Array] => {
    const dict = `{'descr': '<f4', 'fortran_order': False, 'shape': (${shape.join(', ')},), }`;
    const header = new TextEncoder().encode(`${dict.padEnd(117)}\n`);
    const head = [0x93, ...new TextEncoder().encode('NUMPY'), 1, 0, header.length, 0, ...header];
    const length = shape.reduce((product, n) => product * n, 1);
    const values = Float32Array.from({ length }, (_, i) => value(i));
    return [`${name}.npy`, Uint8Array.from([...head, ...new Uint8Array(values.buffer)])];
  };
  const golden = zipSync(
    Object.fromEntries([
      npy('leader', [8, 22, 3], Math.sin),
      npy('music', [8, 54], () => 0),
      npy('music_valid', [8], () => 0),
      npy('role', [1], () => 0),
      npy('coarse', [3], () => 0),
      npy('fine', [3], () => 0),
      npy('music_guidance', [1], () => 0),
      npy('seed', [1], () => 0),
      npy('reactor', [8, 22, 3], () => 0),
    ]),
  );
  await page.route('**/tiny/golden.npz', (route) =>
    route.fulfill({ contentType: 'application/octet-stream', body: Buffer.from(golden) }),
  );
  const open = () =>
    page.evaluate(() => model.open({ manifestUrl: 'tiny/manifest.json', backend: 'webgpu' }));
  // A reference of another model, as a server has for a moment while it gets a new one.
  expect(await open()).toMatchObject({ error: { code: 'model-corrupt' } });
  await page.route('**/tiny/manifest.json', async (route) => {
    const response = await route.fetch();
    const manifest = (await response.json()) as Manifest;
    const sha256 = createHash('sha256').update(golden).digest('hex');
    const listed = { ...manifest.golden, bytes: golden.length, sha256 };
    await route.fulfill({ response, json: { ...manifest, golden: listed } });
  });
  expect(await open()).toMatchObject({
    backend: {
      name: 'wasm',
      reason: expect.stringMatching(/^The GPU's numbers differed from the reference by [\d.]+ m/),
    },
  });
});

test('the worker computes on WebGPU as Python does, without a word in the console, and a device that is lost in the middle of a run moves the work to the processor', async ({
  page,
}) => {
  const said: string[] = [];
  page.on('console', (message) => {
    if (!message.text().startsWith('Failed to load resource')) said.push(message.text());
  });
  // The worker's own script, with a note of the device that it asks for and of the work that it gives to it.
  await page.route('**/assets/worker-*.js', async (route) => {
    const response = await route.fetch();
    const noteDevice = `{
      const { requestDevice } = GPUAdapter.prototype;
      GPUAdapter.prototype.requestDevice = async function (...options) {
        return (globalThis.device = await requestDevice.apply(this, options));
      };
      const { submit } = GPUQueue.prototype;
      globalThis.submissions = 0;
      GPUQueue.prototype.submit = function (...options) {
        globalThis.submissions += 1;
        submit.apply(this, options);
      };
    }`;
    await route.fulfill({ response, body: noteDevice + (await response.text()) });
  });
  await page.goto('/');
  const opened = await page.evaluate(() =>
    model.open({ manifestUrl: 'tiny/manifest.json', backend: 'webgpu' }),
  );
  expect(opened).toMatchObject({ backend: { name: 'webgpu' } });
  const checked = await page.evaluate(() => model.statuses.find(({ kind }) => kind === 'checked'));
  expect(checked !== undefined && 'error' in checked ? checked.error : NaN).toBeLessThan(1e-4);
  const [worker] = page.workers();
  expect(await worker?.evaluate('submissions')).toBeGreaterThan(0);
  expect(said).toEqual([]);
  await page.evaluate(() => model.readGolden('tiny/golden.npz'));
  const frames = 600;
  const generating = page.evaluate((asked) => model.generate(asked), frames);
  await expect.poll(() => page.evaluate(() => model.steps)).toBeGreaterThan(0);
  await worker?.evaluate('device.destroy()');
  const { positions, error } = await generating;
  expect(error).toBeUndefined();
  expect(positions).toHaveLength(frames * 66);
  expect(await page.evaluate(() => model.statuses)).toContainEqual(
    expect.objectContaining({ kind: 'notice', code: 'gpu-lost' }),
  );
  expect(await page.evaluate(() => model.statuses.at(-1))).toMatchObject({
    kind: 'ready',
    backend: {
      name: 'wasm',
      reason: expect.stringMatching(/^The graphics card stopped .* the processor is used/),
    },
  });
});
