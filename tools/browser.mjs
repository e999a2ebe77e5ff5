import { existsSync } from 'node:fs';
import path from 'node:path';

/** Programs that are looked for in PATH. */
const names = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'];
/** Where macOS and Windows install Chrome, outside PATH. */
const installed = [
  '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
  'C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe',
];

/**
 * The Chromium that the browser tests drive: the one named by CHROMIUM, the system's, or Playwright's own.
 *
 * @returns {Promise<string | undefined>} its path
 */
export async function findBrowser() {
  const folders = (process.env['PATH'] ?? '').split(path.delimiter).filter((folder) => folder !== '');
  const system = names.flatMap((name) => folders.map((folder) => path.join(folder, name)));
  const { chromium } = await import('@playwright/test');
  const named = process.env['CHROMIUM'];
  const candidates = [
    ...(named === undefined ? [] : [named]),
    ...system,
    ...installed,
    chromium.executablePath(),
  ];
  return candidates.find((candidate) => candidate !== '' && existsSync(candidate));
}
