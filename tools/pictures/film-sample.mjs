/**
 * Films the sample video that the first screen offers: one of our leaders on our own mannequin.
 *
 *     node tools/pictures/film-sample.mjs web/public/leaders/sample.webm
 */
import { writeFile } from 'node:fs/promises';
import path from 'node:path';
import { chromium } from '@playwright/test';
import { servePage } from '../bench/built-page.mjs';
import { findBrowser } from '../browser.mjs';

const SECONDS = 9;
/** A phone held upright at the height of a chest; metres and pixels. */
const SHOT = {
  width: 300,
  height: 400,
  focal: 350,
  position: [-0.2, 1.25, 2],
  target: [-0.48, 0.78, -0.15],
  fps: 20,
  clothed: true,
  bitrate: 330_000,
};

const [file] = process.argv.slice(2);
if (!file) {
  console.error('Usage: node tools/pictures/film-sample.mjs FILE.webm');
  process.exit(2);
}
const executablePath = await findBrowser();
if (executablePath === undefined) throw new Error('No Chromium was found; name one in CHROMIUM.');
const site = await servePage(path.resolve(import.meta.dirname, '../../tests/e2e/support/video-page'), {});
const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
try {
  const page = await browser.newPage();
  await page.goto(site.url);
  const film = `video.film('slow', ${JSON.stringify(SHOT)}, ${SECONDS})`;
  const bytes = Buffer.from(/** @type {string} */ (await page.evaluate(film)), 'base64');
  await writeFile(file, bytes);
  console.log(`${file}: ${SECONDS} s, ${Math.round(bytes.length / 1000)} kB`);
} finally {
  await browser.close();
  await site.close();
}
