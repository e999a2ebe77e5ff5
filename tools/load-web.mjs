import { runnerImport } from 'vite';

/**
 * Loads a TypeScript module of web/ into Node, for programs that compute as the page does.
 *
 * @template T
 * @param {string} file its path under web/, as in 'motion/fit/ik.ts'
 * @returns {Promise<T>}
 */
export async function loadWeb(file) {
  const { module } = await runnerImport(new URL(`../web/${file}`, import.meta.url).pathname);
  return /** @type {T} */ (module);
}
