import { openApp, until } from './browser.mjs';

/**
 * From an empty cache and a local server to the first dance that the page has generated, of the demo's leader and song.
 *
 * @param {import('../browser.mjs').Where} where
 * @returns {Promise<{ ready: number, generated: number, megabytes: number }>} seconds until the model is ready and until
 *   the dance is there, and what the server has sent by then
 */
export async function measureColdStart(where) {
  const app = await openApp(where);
  try {
    const start = performance.now();
    const since = () => (performance.now() - start) / 1000;
    await app.start();
    const ready = since();
    await app.page.getByRole('button', { name: 'Generate' }).click();
    await until(app.page, 's.reaction?.label === null && !s.job');
    return { ready, generated: since(), megabytes: app.bytes() / 1e6 };
  } finally {
    await app.close();
  }
}
