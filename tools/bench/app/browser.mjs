/** The built app in a browser, with a count of the bytes that its server sends. */
import { readFileSync } from 'node:fs';
import { chromium } from '@playwright/test';
import { findBrowser } from '../../browser.mjs';
import { root } from '../../run.mjs';
import { createSite, listen } from '../../serve.mjs';
import path from 'node:path';

/** @typedef {Awaited<ReturnType<typeof openApp>>} OpenApp */

/** Serves dist/ and starts a browser on an empty profile. */
export async function openApp() {
  const executablePath = await findBrowser();
  if (executablePath === undefined) throw new Error('No Chromium was found; name one in CHROMIUM.');
  const server = createSite({ root: path.join(root, 'dist') });
  /** @type {Set<import('node:net').Socket>} */
  const sockets = new Set();
  server.on('connection', (socket) => sockets.add(socket));
  const url = await listen(server, { port: 0 });
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
  const session = await browser.newBrowserCDPSession();
  return {
    address: `${url}?backend=wasm`,
    page: await browser.newPage({ viewport: { width: 1280, height: 720 } }),
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
    return Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))?.[1] ?? NaN) / 1024;
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
