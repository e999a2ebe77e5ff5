import { defineConfig } from '@playwright/test';
import { findBrowser } from './tools/browser.mjs';

const browser = await findBrowser();
if (browser === undefined) throw new Error('No Chromium was found: npm test installs one');

// The app's server is a fixture (tests/e2e/support/fixtures.ts), on a port of its own, so that two runs can't meet.
export default defineConfig({
  testDir: 'tests/e2e',
  outputDir: 'test-results',
  forbidOnly: process.env['CI'] !== undefined,
  // Much of a test is waiting, so two of them share two cores well.
  workers: 2,
  // Shared machines stall now and then. What passes only the second time is listed as flaky.
  retries: 1,
  timeout: 180_000,
  expect: { timeout: 15_000 },
  reporter: 'list',
  use: {
    viewport: { width: 1280, height: 800 },
    screenshot: 'only-on-failure',
    // A page that a service worker serves is no longer the one that a test has routed; offline.spec.ts allows it.
    serviceWorkers: 'block',
    launchOptions: {
      executablePath: browser,
      args: [
        '--no-sandbox',
        // WebGPU without a GPU.
        '--enable-unsafe-webgpu',
        '--use-webgpu-adapter=swiftshader',
        // A browser that asks nobody for anything of its own accord.
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
      ],
    },
  },
});
