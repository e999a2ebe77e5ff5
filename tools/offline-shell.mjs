import { createHash } from 'node:crypto';
import { readdir, readFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { isolationHeaders } from './security-headers.mjs';

const source = fileURLToPath(new URL('../web/offline/service-worker.ts', import.meta.url));
const SCRIPT = 'service-worker.js';

/** Kept by other means (runtime and models), for servers or people only, or the service worker itself. */
const LEFT_OUT = /^models\/|\.wasm$|\.br$|\.md$|^service-worker\.js$/;

/**
 * Writes service-worker.js into a built page, with the list of the page's files.
 *
 * @param {string} dist folder of the built page
 */
export async function writeServiceWorker(dist) {
  const entries = await readdir(dist, { recursive: true, withFileTypes: true });
  const paths = entries
    .filter((entry) => entry.isFile())
    .map((entry) => path.relative(dist, path.join(entry.parentPath, entry.name)).replaceAll(path.sep, '/'))
    .filter((file) => !LEFT_OUT.test(file))
    .sort();
  /** @type {Record<string, string>} */
  const files = {};
  for (const file of paths) {
    const content = await readFile(path.join(dist, file));
    files[file] = `sha256-${createHash('sha256').update(content).digest('base64')}`;
  }
  const version = createHash('sha256').update(JSON.stringify(files)).digest('hex').slice(0, 16);
  await build({
    configFile: false,
    publicDir: false,
    logLevel: 'error',
    define: { SHELL: JSON.stringify({ version, files, headers: isolationHeaders }) },
    build: {
      outDir: dist,
      emptyOutDir: false,
      target: 'es2023',
      rolldownOptions: { input: source, output: { format: 'iife', entryFileNames: SCRIPT } },
    },
  });
}

/**
 * Makes a build serve itself without a connection.
 *
 * @param {string} dist folder of the built page
 * @returns {import('vite').Plugin}
 */
export function offlineShell(dist) {
  return {
    name: 'offline-shell',
    apply: 'build',
    // Before the copies for servers are made: they are no part of the page.
    closeBundle: { order: 'pre', sequential: true, handler: () => writeServiceWorker(dist) },
  };
}
