import { setTimeout as sleep } from 'node:timers/promises';
import { chromium } from '@playwright/test';
import { findBrowser } from '../browser.mjs';

/** @typedef {{ backend: 'wasm' | 'webgpu', gpu: boolean }} Where the model computes, and whether the browser has a graphics card */

/**
 * What Chromium without a window needs on Linux to use a graphics card. On a server's card its compositor crashed where
 * WebGPU was on, so there the processor puts the page together, of the parts that the card has drawn.
 */
const GPU_FLAGS = {
  wasm: ['--use-angle=vulkan'],
  webgpu: [
    '--enable-features=Vulkan',
    '--disable-vulkan-surface',
    '--use-angle=gl-egl',
    '--disable-gpu-compositing',
    '--disable-gpu-rasterization',
  ],
};

/**
 * @param {Where} where
 * @throws {Error} if there is no Chromium, or it cannot use a card
 */
export async function launchBrowser({ backend, gpu }) {
  const executablePath = await findBrowser();
  if (executablePath === undefined) throw new Error('No Chromium was found; name one in CHROMIUM.');
  const args = ['--no-sandbox'];
  if (gpu) args.push('--enable-gpu', '--ignore-gpu-blocklist', '--enable-unsafe-webgpu');
  if (gpu && process.platform === 'linux') args.push(...GPU_FLAGS[backend]);
  const browser = await chromium.launch({ executablePath, args });
  if (gpu && !(await drawsByCard(browser))) {
    await browser.close();
    throw new Error('Chromium found no graphics card here; leave --gpu out.');
  }
  return browser;
}

/**
 * Whether its pages answer and have WebGL: with the flags above and no card they wait for it for ever.
 *
 * @param {import('@playwright/test').Browser} browser
 */
async function drawsByCard(browser) {
  const tab = await browser.newPage();
  const found = tab.evaluate(`document.createElement('canvas').getContext('webgl2') !== null`);
  const answer = await Promise.race([found, sleep(20_000, false)]);
  await Promise.race([tab.close(), sleep(1000)]);
  return answer;
}

/**
 * Times the page of page/main.ts with so many threads each, and with WebGPU, each in a fresh tab.
 *
 * @param {import('@playwright/test').Browser} browser
 * @param {string} url of the page
 * @param {{ threadCounts: number[], gpu: boolean, repeats: string }} options
 * @returns {Promise<import('./table.mjs').Row[]>}
 * @throws {Error} if the page computed elsewhere than it was asked to
 */
export async function measureBackends(browser, url, { threadCounts, gpu, repeats }) {
  const asked = threadCounts.map((threads) => ({ preference: 'wasm', backend: 'wasm', threads }));
  // 'auto' takes no software adapter.
  if (gpu) asked.push({ preference: 'auto', backend: 'webgpu', threads: 1 });
  const rows = [];
  for (const { preference, backend, threads } of asked) {
    const tab = await browser.newPage();
    await tab.goto(url);
    const call = `measure('${preference}', ${threads}, ${Number(repeats)})`;
    const measured = /** @type {import('./page/main').Measured} */ (await tab.evaluate(call));
    if (measured.backend !== backend || measured.threads !== threads) {
      throw new Error(
        `Asked for ${backend} with ${threads} threads, got ${measured.threads}: ${measured.reason}`,
      );
    }
    rows.push({ ...measured, backend: `browser ${backend === 'webgpu' ? 'WebGPU' : backend}` });
    await tab.close();
  }
  return rows;
}
