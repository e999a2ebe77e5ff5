import path from 'node:path';
import { choose, median, openApp, SETTLED, until } from './browser.mjs';
import { writeLeader, writeSong } from './files.mjs';

const MOVES = 20;

/**
 * While the dance plays, the fine fader is moved: milliseconds from the input event until a picture with new frames has
 * been drawn, and until one of the whole new dance. Pictures are drawn all the time; `picture` is how long one takes.
 *
 * @param {string} folder for the files
 * @param {number} frames of the dance
 * @param {import('../browser.mjs').Where} where
 * @returns {Promise<{ first: number, whole: number, picture: number }>} medians of 20 moves
 */
export async function measureSlider(folder, frames, where) {
  const [song, leader] = [path.join(folder, 'slider.wav'), path.join(folder, 'slider.bvh')];
  await writeSong(song, frames / 30);
  await writeLeader(leader, frames);
  const app = await openApp(where);
  try {
    const { page } = app;
    await app.start();
    await choose(page, 'song', song);
    await until(page, `${SETTLED} && s.song.name === 'slider.wav'`);
    await choose(page, 'leader', leader);
    await until(page, `${SETTLED} && s.reaction?.inputs.leader.name === 'slider.bvh'`);
    // In a loop, so that it never ends.
    await page.keyboard.press('l');
    await page.keyboard.press('Space');
    await until(page, 's.playback.playing && s.playback.time > 1');
    /** @type {Move[]} */
    const moves = [];
    for (let move = 0; move <= MOVES; move++) {
      const watching = page.evaluate(watchOneMove);
      await page.getByRole('slider', { name: 'Fine guidance' }).fill(String(0.1 + ((move * 7) % 19) / 20));
      moves.push(await watching);
    }
    // The first one samples what the others blend.
    const counted = moves.slice(1);
    return {
      first: median(counted.map(({ first }) => first)),
      whole: median(counted.map(({ whole }) => whole)),
      picture: median(counted.map(({ picture }) => picture)),
    };
  } finally {
    await app.close();
  }
}

/** @typedef {{ first: number, whole: number, picture: number }} Move milliseconds of one move */

/**
 * Runs in the page.
 *
 * @returns {Promise<Move>}
 */
function watchOneMove() {
  const { stage, store } = /** @type {{ stage: any, store: any }} */ (Reflect.get(globalThis, 'reactdance'));
  const before = store.getState();
  return new Promise((resolve) => {
    let asked = NaN;
    globalThis.addEventListener('input', () => (asked = performance.now()), { once: true, capture: true });
    /** Pictures drawn when the new frames, and the whole, came into the state. */
    let [pictureOfPart, pictureOfWhole, first] = [NaN, NaN, NaN];
    const drawnAtStart = stage.stats().frames;
    const begin = performance.now();
    const look = () => {
      const { preview, reaction } = store.getState();
      const { frames } = stage.stats();
      const renewed = reaction !== before.reaction;
      if (Number.isNaN(pictureOfPart) && (renewed || (preview && preview !== before.preview)))
        pictureOfPart = frames;
      if (Number.isNaN(pictureOfWhole) && renewed) pictureOfWhole = frames;
      if (Number.isNaN(first) && frames > pictureOfPart) first = performance.now() - asked;
      if (frames > pictureOfWhole) {
        const now = performance.now();
        resolve({ first, whole: now - asked, picture: (now - begin) / (frames - drawnAtStart) });
      } else setTimeout(look, 2);
    };
    look();
  });
}
