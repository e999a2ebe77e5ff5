import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import type { OutgoingHttpHeaders, ServerResponse } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { createSite, listen } from '../../../tools/serve.mjs';
import { test as base } from './fixtures';

const project = path.resolve(import.meta.dirname, '../../..');

/** A server of the built page that a test can stop and change. */
interface Host {
  readonly root: string;
  readonly stop: () => Promise<void>;
  readonly start: () => Promise<string>;
  /** Whether the browser is told to keep nothing that it is sent. */
  storesNothing: boolean;
}

/** The test of `fixtures` on a copy of the build, with a service worker. */
export const test = base.extend<object, { host: Host; site: string }>({
  serviceWorkers: 'allow',
  host: [
    // eslint-disable-next-line no-empty-pattern -- Playwright reads the wanted fixtures from this pattern
    async ({}, use) => {
      const root = mkdtempSync(path.join(tmpdir(), 'reactdance-offline-'));
      cpSync(path.join(project, 'dist'), root, {
        recursive: true,
        filter: (file) => !/\.br$|models.salsa/.test(file),
      });
      const mounts = { '/models/tiny/': path.join(project, 'tests/fixtures/tiny-model') };
      const server = createSite({ root, mounts });
      server.prependListener('request', (_, response: ServerResponse) => {
        const writeHead = response.writeHead.bind(response);
        Object.assign(response, {
          writeHead: (status: number, headers: OutgoingHttpHeaders) =>
            writeHead(status, { ...headers, ...(host.storesNothing && { 'Cache-Control': 'no-store' }) }),
        });
      });
      let port = 0;
      const start = async (): Promise<string> => {
        const address = await listen(server, { port });
        port = Number(new URL(address).port);
        return address;
      };
      const stop = (): Promise<void> =>
        new Promise((resolve) => {
          server.close(() => {
            resolve();
          });
          server.closeAllConnections();
        });
      const host: Host = { root, start, stop, storesNothing: false };
      await use(host);
      await stop();
      rmSync(root, { recursive: true });
    },
    { scope: 'worker' },
  ],
  site: [async ({ host }, use) => use(await host.start()), { scope: 'worker' }],
});
