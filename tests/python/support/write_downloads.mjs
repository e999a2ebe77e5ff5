/**
 * Writes the shipped demo in the page's formats, and what it should read as.
 *
 *     node tests/python/support/write_downloads.mjs folder
 */
import { readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { loadWeb } from '../../../tools/load-web.mjs';

const [folder] = process.argv.slice(2);
if (!folder) throw new Error('Usage: node tests/python/support/write_downloads.mjs folder');

/** @type {typeof import('../../../web/motion/import/bvh/read')} */
const { readBvh } = await loadWeb('motion/import/bvh/read.ts');
/** @type {typeof import('../../../web/motion/retarget/leader')} */
const { leaderOf } = await loadWeb('motion/retarget/leader.ts');
/** @type {typeof import('../../../web/motion/fit/ik')} */
const { solve } = await loadWeb('motion/fit/ik.ts');
/** @type {typeof import('../../../web/export/client')} */
const { writeMotion } = await loadWeb('export/client.ts');

/** @type {(role: 'leader' | 'reactor') => Promise<{ role: 'leader' | 'reactor', motion: import('../../../web/motion/skeleton/clip').SolvedMotion }>} */
const dancer = async (role) => {
  const text = await readFile(new URL(`../../../web/public/demo/${role}.bvh`, import.meta.url), 'utf8');
  return { role, motion: solve(leaderOf(readBvh(text)).clip) };
};
const dancers = [await dancer('leader'), await dancer('reactor')];
const about = {
  song: 'Señor “Patio” 舞💃.mp3',
  leader: 'lead_0412.bvh',
  take: null,
  model: { id: 'salsa', name: 'Salsa' },
  settings: { guidance: { coarse: 1.2, fine: 0.6 }, steps: 5, seed: 1204 },
  footLock: true,
};

/** @param {string} name @param {Blob} file */
const write = async (name, file) =>
  writeFile(path.join(folder, name), new Uint8Array(await file.arrayBuffer()));
for (const { role, motion } of dancers) {
  await write(`${role}.f32`, new Blob([new Float32Array(motion.positions)]));
  const one = { about, dancers: dancers.filter((each) => each.role === role) };
  await write(`${role}.bvh`, await writeMotion('bvh', one, 'dark'));
}
await write('both.npz', await writeMotion('npz', { about, dancers }, 'dark'));
await write('reactor.npz', await writeMotion('npz', { about, dancers: dancers.slice(1) }, 'dark'));
await write('both.json', await writeMotion('json', { about, dancers }, 'dark'));
