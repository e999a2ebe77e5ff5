/**
 * Makes docs/dance.webp, the looping picture of the README, from the built app's demo:
 *
 *     npx vite build && node tools/pictures/moving-picture.mjs [VIDEO]
 *
 * The page writes a video of its demo, which takes minutes without a GPU; VIDEO is one that it has written before. The
 * part whose last picture is most like its first becomes the loop; its end is cross-faded with the pictures before its
 * beginning. Needs ffmpeg.
 */
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { isProgram, root } from '../run.mjs';
import { withBuiltApp } from './built-app.mjs';

/** Pixels. */
const PAGE = { width: 1280, height: 800 };
/** Pixels that are kept of the stage's picture, around its middle. */
const CROP = { width: 450, height: 510 };
/** Pixels of the finished picture's width. */
const WIDTH = 450;
/** Pictures a second that are compared; the loop keeps all of them. */
const SEARCH_FPS = 15;
const LOOP_SECONDS = { shortest: 7, longest: 9 };
/** Left out at the start and the end of the dance, where the couple comes together and parts. */
const EDGE_SECONDS = 4;
const FADE_SECONDS = 0.4;
const QUALITY = 65;
/** Edge length of the small grey pictures that are compared. */
const SMALL = 48;
const WAIT_MS = 1_500_000;

/**
 * Opens the built app and saves the video of its demo.
 *
 * @param {string} file where the video is put
 */
async function filmDemo(file) {
  await withBuiltApp(async (browser, address) => {
    const page = await browser.newPage({ viewport: PAGE, colorScheme: 'dark', serviceWorkers: 'block' });
    page.setDefaultTimeout(WAIT_MS);
    await page.goto(address);
    await page.getByRole('button', { name: 'Play the demo' }).click();
    await page.getByRole('button', { name: 'Pause', exact: true }).click();
    await page.getByRole('radio', { name: 'Follow' }).click();
    await page.getByRole('button', { name: 'Download', exact: true }).click();
    await page.getByRole('radio', { name: /As on stage/ }).click();
    const coming = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save video' }).click();
    await (await coming).saveAs(file);
  });
}

/** @param {string[]} args */
function ffmpeg(...args) {
  const options = { maxBuffer: 2 ** 30 };
  return execFileSync('ffmpeg', ['-loglevel', 'error', '-y', ...args], options);
}

/**
 * The stretch of a video that loops best.
 *
 * @param {string} video
 * @returns {{ start: number, seconds: number }}
 */
function findLoop(video) {
  const filter = `fps=${SEARCH_FPS},crop=${CROP.width}:${CROP.height},scale=${SMALL}:${SMALL},format=gray`;
  const bytes = ffmpeg('-i', video, '-vf', filter, '-f', 'rawvideo', '-');
  const size = SMALL * SMALL;
  const count = bytes.length / size;
  /** @param {number} a @param {number} b numbers of pictures */
  const difference = (a, b) => {
    let sum = 0;
    for (let i = 0; i < size; i++) sum += ((bytes[a * size + i] ?? 0) - (bytes[b * size + i] ?? 0)) ** 2;
    return sum;
  };
  const edge = EDGE_SECONDS * SEARCH_FPS;
  let best = { start: 0, seconds: LOOP_SECONDS.shortest, difference: Infinity };
  for (let start = edge; start < count - edge; start++)
    for (
      let end = start + LOOP_SECONDS.shortest * SEARCH_FPS;
      end <= Math.min(start + LOOP_SECONDS.longest * SEARCH_FPS, count - edge);
      end++
    ) {
      // The pictures two earlier are compared too, so that both ends have the same motion.
      const now = difference(start, end) + difference(start - 2, end - 2);
      if (now < best.difference)
        best = { start: start / SEARCH_FPS, seconds: (end - start) / SEARCH_FPS, difference: now };
    }
  return best;
}

/**
 * Writes the loop: its last moments are faded into the moments before its beginning.
 *
 * @param {string} video
 * @param {{ start: number, seconds: number }} loop
 * @param {string} file
 */
function writeLoop(video, { start, seconds }, file) {
  const look = `crop=${CROP.width}:${CROP.height},scale=${WIDTH}:-2:flags=lanczos,setpts=PTS-STARTPTS`;
  const filter = [
    `[0]trim=${start}:${start + seconds},${look}[body]`,
    `[1]trim=${start - FADE_SECONDS}:${start},${look}[before]`,
    `[body][before]xfade=transition=fade:duration=${FADE_SECONDS}:offset=${seconds - FADE_SECONDS}`,
  ].join(';');
  const webp = ['-c:v', 'libwebp_anim', '-quality', String(QUALITY), '-compression_level', '6', '-loop', '0'];
  ffmpeg('-i', video, '-i', video, '-filter_complex', filter, ...webp, '-an', file);
}

if (isProgram(import.meta.url)) {
  const folder = mkdtempSync(path.join(tmpdir(), 'reactdance-'));
  const [given] = process.argv.slice(2);
  const video = given ?? path.join(folder, 'demo.mp4');
  try {
    if (given === undefined) await filmDemo(video);
    const loop = findLoop(video);
    const file = path.join(root, 'docs/dance.webp');
    writeLoop(video, loop, file);
    const kilobytes = Math.round(statSync(file).size / 1000);
    console.log(
      `docs/dance.webp: ${loop.seconds.toFixed(1)} s from ${loop.start.toFixed(1)} s on, ${kilobytes} kB`,
    );
  } finally {
    rmSync(folder, { recursive: true });
  }
}
