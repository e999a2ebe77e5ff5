import { runnerImport } from 'vite';

/**
 * A module of the page, for programs that run without a page.
 *
 * @template T
 * @param {string} file its path under web/, as in 'motion/fit/ik.ts'
 * @returns {Promise<T>}
 */
export async function loadWeb(file) {
  const { module } = await runnerImport(new URL(`../web/${file}`, import.meta.url).pathname);
  return /** @type {T} */ (module);
}
