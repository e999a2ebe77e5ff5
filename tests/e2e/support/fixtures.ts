import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { test as base, expect } from '@playwright/test';
import { createSite, listen } from '../../../tools/serve.mjs';
import { demoFiles, usualSettings } from './made-demo';

export { expect };

const project = path.resolve(import.meta.dirname, '../../..');

interface WorkerFixtures {
  /**
   * Whether the page has the demo that ships with it. Most tests have a made one of five seconds: reading the shipped
   * song takes more of a processor than all else that the page does at its start.
   */
  readonly shippedDemo: boolean;
  /** Address of the built app; the tiny model of the fixtures is below models/tiny/, a second copy of the app below copy/. */
  readonly site: string;
}

interface TestFixtures {
  /** Addresses that the browser requested in this test. After the test none may be of another origin. */
  readonly requests: string[];
}

/** Playwright's test, with the built app served as `npm start` does and every request of the browser watched. */
export const test = base.extend<TestFixtures, WorkerFixtures>({
  shippedDemo: [false, { scope: 'worker', option: true }],

  site: [
    async ({ shippedDemo }, use) => {
      const root = path.join(project, 'dist');
      if (!existsSync(path.join(root, 'index.html')))
        throw new Error('dist/ is empty: npm run build comes first');
      const demo = mkdtempSync(path.join(tmpdir(), 'reactdance-demo-'));
      for (const [name, content] of Object.entries(demoFiles(usualSettings, 150)))
        writeFileSync(path.join(demo, name), content);
      const mounts = {
        '/models/tiny/': path.join(project, 'tests/fixtures/tiny-model'),
        '/copy/': root,
        ...(shippedDemo ? {} : { '/demo/': demo }),
      };
      const server = createSite({ root, mounts });
      await use(await listen(server, { port: 0 }));
      server.close();
      server.closeAllConnections();
      rmSync(demo, { recursive: true });
    },
    { scope: 'worker' },
  ],

  baseURL: ({ site }, use) => use(site),

  requests: [
    async ({ context, site }, use) => {
      const requests: string[] = [];
      context.on('request', (request) => requests.push(request.url()));
      context.on('page', (page) => page.on('websocket', (socket) => requests.push(socket.url())));
      await use(requests);
      expect(otherOrigins(requests, site), 'nothing leaves the page').toEqual([]);
    },
    { auto: true },
  ],
});

/**
 * The addresses of other origins; blob: and data: addresses are the page's own.
 *
 * @param site address of the app
 */
export function otherOrigins(addresses: readonly string[], site: string): string[] {
  const own = new URL(site).origin;
  return addresses.filter((address) => {
    const { protocol, origin } = new URL(address);
    return protocol !== 'blob:' && protocol !== 'data:' && origin !== own;
  });
}
