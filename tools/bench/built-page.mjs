import { mkdtemp, rm } from 'node:fs/promises';
import os from 'node:os';
import path from 'node:path';
import { build } from 'vite';
import { createSite, listen } from '../serve.mjs';
import { manifestEntry } from '../vite/manifest-entry.mjs';

/**
 * Builds a small page with the settings of vite.config.ts that matter to speed, and serves it as the app is served.
 *
 * @param {string} root folder with index.html
 * @param {Record<string, string>} mounts address prefix, as '/model/', to the folder served there
 * @returns {Promise<{ url: string, close: () => Promise<void> }>}
 */
export async function servePage(root, mounts) {
  const outDir = await mkdtemp(path.join(os.tmpdir(), 'reactdance-page-'));
  await build({
    configFile: false,
    root,
    base: './',
    publicDir: false,
    logLevel: 'error',
    plugins: [manifestEntry()],
    worker: { format: 'es', plugins: () => [manifestEntry()] },
    build: { outDir, emptyOutDir: true, target: 'es2023', assetsInlineLimit: 0, chunkSizeWarningLimit: 5000 },
  });
  const server = createSite({ root: outDir, mounts });
  // A program whose browser does not start ends, although it served the page already.
  server.unref();
  const url = await listen(server, { port: 0 });
  return {
    url,
    close: async () => {
      server.closeAllConnections();
      await new Promise((resolve) => server.close(resolve));
      await rm(outDir, { recursive: true, force: true });
    },
  };
}
