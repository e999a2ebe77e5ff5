import path from 'node:path';
import { runnerImport } from 'vite';
import { root } from './run.mjs';

/**
 * Loads a TypeScript module of web/ into Node, for programs that compute as the page does.
 *
 * @template T
 * @param {string} file its path under web/, as in 'motion/fit/ik.ts'
 * @returns {Promise<T>}
 */
export async function loadWeb(file) {
  const { module } = await runnerImport(path.join(root, 'web', file));
  return /** @type {T} */ (module);
}
