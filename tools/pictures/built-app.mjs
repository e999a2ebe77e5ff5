import path from 'node:path';
import { chromium } from '@playwright/test';
import { findBrowser } from '../browser.mjs';
import { root } from '../run.mjs';
import { createSite, listen } from '../serve.mjs';

/**
 * Serves `dist/` and opens a browser while `work` goes on.
 *
 * @param {(browser: import('@playwright/test').Browser, address: string) => Promise<void>} work
 * @throws {Error} where there is no Chromium
 */
export async function withBuiltApp(work) {
  const executablePath = await findBrowser();
  if (executablePath === undefined) throw new Error('No Chromium was found; name one in CHROMIUM.');
  const site = createSite({ root: path.join(root, 'dist') });
  const address = await listen(site, { port: 0 });
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
  try {
    await work(browser, address);
  } finally {
    await browser.close();
    site.close();
    site.closeAllConnections();
  }
}
