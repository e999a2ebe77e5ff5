/** The built app in a browser, with a count of the bytes that its server sends. */
import { readFileSync } from 'node:fs';
import { root } from '../../run.mjs';
import { createSite, listen } from '../../serve.mjs';
import path from 'node:path';
import { launchBrowser } from '../browser.mjs';

/** @typedef {Awaited<ReturnType<typeof openApp>>} OpenApp */

/**
 * Serves dist/ and starts a browser on an empty profile.
 *
 * @param {import('../browser.mjs').Where} where
 */
export async function openApp({ backend, gpu }) {
  const browser = await launchBrowser({ backend, gpu });
  const server = createSite({ root: path.join(root, 'dist') });
  /** @type {Set<import('node:net').Socket>} */
  const sockets = new Set();
  server.on('connection', (socket) => sockets.add(socket));
  const url = await listen(server, { port: 0 });
  const session = await browser.newBrowserCDPSession();
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  return {
    page,
    /** Opens the page and waits until the model is ready, where it was asked to be. */
    start: async () => {
      // Where nothing is asked for, the page takes WebGPU if there is a card, and no software adapter.
      await page.goto(backend === 'wasm' ? `${url}?backend=wasm` : url);
      await until(page, SETTLED);
      const where = /** @type {string} */ (await page.evaluate('reactdance.store.getState().model.backend'));
      if (where !== backend) throw new Error(`Asked for ${backend}, the page computes on ${where}.`);
    },
    /** Sent so far, headers included. */
    bytes: () => [...sockets].reduce((sum, { bytesWritten }) => sum + bytesWritten, 0),
    /** Resident memory of the processes that draw pages, MB (Linux). */
    memory: async () => {
      const { processInfo } = await session.send('SystemInfo.getProcessInfo');
      return processInfo
        .filter(({ type }) => type === 'renderer')
        .reduce((sum, { id }) => sum + residentMemory(id), 0);
    },
    close: async () => {
      await browser.close();
      server.closeAllConnections();
      await new Promise((resolve) => server.close(resolve));
    },
  };
}

/** @param {number} id of a process */
function residentMemory(id) {
  try {
    return Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))?.[1] ?? 0) / 1024;
  } catch {
    return 0;
  }
}

/**
 * Waits until an expression of the page's state `s` is true.
 *
 * @param {import('@playwright/test').Page} page
 * @param {string} condition
 */
export async function until(page, condition) {
  const end = performance.now() + 1_200_000;
  const expression = `(() => {
    const s = window.reactdance?.store.getState();
    if (s?.problem) throw new Error(s.problem.title);
    return s !== undefined && Boolean(${condition});
  })()`;
  while (!(await page.evaluate(expression))) {
    if (performance.now() > end) throw new Error(`The page never came to ${condition}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** Everything is loaded and nothing is being made. */
export const SETTLED = `s.model.phase === 'ready' && s.demo !== 'loading' && !s.reading.song && !s.reading.leader && !s.job`;

/**
 * Chooses a song or a leader through its button in the bar.
 *
 * @param {import('@playwright/test').Page} page
 * @param {'song' | 'leader'} kind
 * @param {string} file
 */
export async function choose(page, kind, file) {
  const name = kind === 'song' ? /^(Song: |No song yet)/ : /^(Leader: |No leader yet)/;
  const chooser = page.waitForEvent('filechooser');
  await page.getByRole('button', { name }).first().click();
  await (await chooser).setFiles(file);
}

/** @param {number[]} values */
export function median(values) {
  return [...values].sort((a, b) => a - b)[values.length >> 1] ?? NaN;
}
