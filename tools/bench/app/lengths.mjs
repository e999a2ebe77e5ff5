import path from 'node:path';
import { choose, openApp, until } from './browser.mjs';
import { writeLeader, writeSong } from './files.mjs';

const SAMPLE_MS = 200;

/**
 * @typedef {object} Length figures of one dance
 * @property {number} minutes
 * @property {number} song seconds until the song is read
 * @property {number} leader seconds until the leader is read
 * @property {number} dance seconds from there until the dance is ready
 * @property {number} memory most that the page's processes had meanwhile, MB
 * @property {number} longestTask of the page's thread, milliseconds
 */

/**
 * Song and leader of some length, from the files to the partner, each in a page of its own.
 *
 * @param {string} folder for the files
 * @param {number} minutes
 * @param {import('../browser.mjs').Where} where
 * @returns {Promise<Length>}
 */
export async function measureLength(folder, minutes, where) {
  const name = `minutes-${minutes}`;
  const [song, leader] = [path.join(folder, `${name}.wav`), path.join(folder, `${name}.bvh`)];
  await writeSong(song, minutes * 60);
  await writeLeader(leader, Math.round(minutes * 60 * 30));
  const app = await openApp(where);
  /** @type {NodeJS.Timeout | undefined} */
  let sampling;
  try {
    const { page } = app;
    await app.start();
    await page.evaluate(() => {
      Reflect.set(globalThis, 'longestTask', 0);
      new PerformanceObserver((list) => {
        for (const { duration } of list.getEntries())
          Reflect.set(globalThis, 'longestTask', Math.max(duration, Reflect.get(globalThis, 'longestTask')));
      }).observe({ type: 'longtask' });
    });
    let memory = 0;
    sampling = setInterval(() => {
      app.memory().then(
        (now) => (memory = Math.max(memory, now)),
        () => undefined,
      );
    }, SAMPLE_MS);
    let last = performance.now();
    const lap = () => {
      const before = last;
      last = performance.now();
      return (last - before) / 1000;
    };
    await choose(page, 'song', song);
    await until(page, `s.song?.name === '${name}.wav'`);
    const figures = { song: lap(), leader: 0, dance: 0 };
    await choose(page, 'leader', leader);
    await until(page, `s.leader?.name === '${name}.bvh'`);
    figures.leader = lap();
    await until(page, `s.reaction?.inputs.leader.name === '${name}.bvh' && !s.job && s.quality`);
    figures.dance = lap();
    const longestTask = await page.evaluate(
      () => /** @type {number} */ (Reflect.get(globalThis, 'longestTask')),
    );
    return { minutes, ...figures, memory, longestTask };
  } finally {
    clearInterval(sampling);
    await app.close();
  }
}
