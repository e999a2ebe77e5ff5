/**
 * How exact the motion from a video is: compares it with the motions that were filmed, and writes the table of
 * docs/leader-from-video.md.
 *
 *     node tools/video-accuracy.mjs             from the recordings in tests/fixtures/video
 *     node tools/video-accuracy.mjs --record    films and reads the videos first, in Chromium, and records what is seen
 *     node tools/video-accuracy.mjs --record --only walking
 */
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { parseArgs } from 'node:util';
import { chromium } from '@playwright/test';
import { runnerImport } from 'vite';
import { servePage } from './bench/built-page.mjs';
import { findBrowser } from './browser.mjs';
import { root, runMain } from './run.mjs';

const DOCUMENT = path.join(root, 'docs/leader-from-video.md');
const RECORDINGS = path.join(root, 'tests/fixtures/video');
const PAGE = path.join(root, 'tests/e2e/support/video-page');

const { values: options } = parseArgs({
  options: { record: { type: 'boolean', default: false }, only: { type: 'string', default: '' } },
});

/**
 * @template T
 * @param {string} file under tests/web/support/filmed
 * @returns {Promise<T>}
 */
async function load(file) {
  const { module } = await runnerImport(path.join(root, 'tests/web/support/filmed', file));
  return /** @type {T} */ (module);
}

async function record() {
  /** @type {typeof import('../tests/web/support/filmed/shots')} */
  const { FILMED } = await load('shots.ts');
  /** @type {typeof import('../tests/web/support/filmed/recording')} */
  const { encodeRecording } = await load('recording.ts');
  const executablePath = await findBrowser();
  if (executablePath === undefined) throw new Error('No Chromium was found; name one in CHROMIUM.');
  await mkdir(path.join(RECORDINGS, 'mannequin'), { recursive: true });
  const site = await servePage(PAGE, { '/models/': path.join(root, 'web/public/models') });
  const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
  try {
    for (const { name, motion, shot, seconds } of FILMED.filter((one) => one.name.includes(options.only))) {
      const page = await browser.newPage();
      await page.goto(site.url);
      const call = `video.film('${motion}', ${JSON.stringify(shot)}, ${seconds}).then(video.read)`;
      /** @type {Awaited<ReturnType<import('../tests/e2e/support/video-page/main').Page['read']>>} */
      const seen = await page.evaluate(call);
      await writeFile(path.join(RECORDINGS, `${name}.json`), encodeRecording({ ...seen, brightest: 1 }));
      console.log(`${name}: ${seen.times.length} pictures read in ${seen.seconds.toFixed(1)} s`);
      await page.close();
    }
  } finally {
    await browser.close();
    await site.close();
  }
}

async function main() {
  if (options.record) await record();
  /** @type {typeof import('../tests/web/support/filmed/table')} */
  const { accuracyTable, withTable } = await load('table.ts');
  const table = accuracyTable();
  console.log(table);
  await writeFile(DOCUMENT, withTable(await readFile(DOCUMENT, 'utf8'), table));
}

await runMain(main);
