import { createHash } from 'node:crypto';
import { readdir, readFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { isolationHeaders } from '../security-headers.mjs';

const source = fileURLToPath(new URL('../../web/offline/service-worker.ts', import.meta.url));
const SCRIPT = 'service-worker.js';

/** Files that the service worker does not cache: runtime and models have caches of their own, others no page asks for. */
const NOT_CACHED = /^models\/|^site\/|\.wasm$|\.br$|\.md$|^service-worker\.js$/;

/** Files that are cached when they are used first: readers of motion files, and what is offered in their place. */
const ON_USE = /^assets\/reader-|^leaders\//;

/**
 * The name of a worker's chunk, which tells the readers of motion files from other code. The one of BVH is not among
 * them: every visitor reads the demo's leader with it.
 *
 * @param {import('vite').Rolldown.PreRenderedChunk} chunk
 */
export function workerChunkName({ facadeModuleId, moduleIds }) {
  const folder = '/motion/import/';
  const own = moduleIds.filter((id) => !id.startsWith('\0'));
  const [, reader] = /\/motion\/import\/(.+)\.ts$/.exec(facadeModuleId ?? '') ?? [];
  const isShared = own.length > 0 && own.every((id) => id.includes(folder));
  if (reader?.startsWith('bvh/') || !(reader || isShared)) return 'assets/[name]-[hash].js';
  return `assets/reader-${reader?.replace(/\/read$/, '').replaceAll('/', '-') ?? '[name]'}-[hash].js`;
}

/**
 * Writes service-worker.js into a built page: web/offline/service-worker.ts with the list of the page's files and their
 * hashes. It holds code of ours only, which is why licences.txt has no section for it.
 *
 * @param {string} dist folder of the built page
 */
export async function writeServiceWorker(dist) {
  const entries = await readdir(dist, { recursive: true, withFileTypes: true });
  const paths = entries
    .filter((entry) => entry.isFile())
    .map((entry) => path.relative(dist, path.join(entry.parentPath, entry.name)).replaceAll(path.sep, '/'))
    .filter((file) => !NOT_CACHED.test(file))
    .sort();
  /** @type {Record<string, string>} */
  const files = {};
  /** @type {Record<string, string>} */
  const onUse = {};
  for (const file of paths) {
    const content = await readFile(path.join(dist, file));
    const integrity = `sha256-${createHash('sha256').update(content).digest('base64')}`;
    (ON_USE.test(file) ? onUse : files)[file] = integrity;
  }
  const version = createHash('sha256')
    .update(JSON.stringify([files, onUse]))
    .digest('hex')
    .slice(0, 16);
  await build({
    configFile: false,
    publicDir: false,
    logLevel: 'error',
    define: { SHELL: JSON.stringify({ version, files, onUse, headers: isolationHeaders }) },
    build: {
      outDir: dist,
      emptyOutDir: false,
      target: 'es2023',
      rolldownOptions: { input: source, output: { format: 'iife', entryFileNames: SCRIPT } },
    },
  });
}

/**
 * Adds a service worker to the build, so that the page starts without a connection from its second visit on.
 *
 * @type {import('vite').Plugin}
 */
export const serviceWorker = {
  name: 'service-worker',
  apply: 'build',
  closeBundle: {
    // Before the .br copies are made: only servers use them.
    order: 'pre',
    sequential: true,
    handler() {
      const { root, build } = this.environment.config;
      return writeServiceWorker(path.resolve(root, build.outDir));
    },
  },
};
