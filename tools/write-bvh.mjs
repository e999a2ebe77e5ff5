/**
 * Solves dancers as the page does and writes each as NAME.bvh.
 *
 *     node tools/write-bvh.mjs motions.npz manifest.json folder
 *
 * motions.npz holds motions by NAME, (T, 22, 3) float32 metres at 30 fps. A `reactor` with a `leader` keeps to what the
 * page lets a partner do (web/motion/contact/beside-partner.ts), to the beats of the `song` where there is one, whose features
 * (T, 54) that is; manifest.json is the model's, whose `quality` has the rules of it.
 */
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { loadWeb } from './load-web.mjs';

const [source, manifest, folder] = process.argv.slice(2);
if (!source || !manifest || !folder) {
  console.error('Usage: node tools/write-bvh.mjs motions.npz manifest.json folder');
  process.exit(2);
}

/** @type {typeof import('../web/model/load/npz')} */
const { readNpz } = await loadWeb('model/load/npz.ts');
/** @type {typeof import('../web/motion/fit/ik')} */
const { solve } = await loadWeb('motion/fit/ik.ts');
/** @type {typeof import('../web/motion/contact/beside-partner')} */
const { besidePartner } = await loadWeb('motion/contact/beside-partner.ts');
/** @type {typeof import('../web/audio/rhythm/rhythm')} */
const { rhythmOf } = await loadWeb('audio/rhythm/rhythm.ts');
/** @type {typeof import('../web/motion/beats/step-timing')} */
const { stepCounts } = await loadWeb('motion/beats/step-timing.ts');
/** @type {typeof import('../web/motion/bvh/write')} */
const { writeBvh } = await loadWeb('motion/bvh/write.ts');

const arrays = readNpz(new Uint8Array(await readFile(source)));
/** @param {string} name */
function clip(name) {
  const { shape, data } = arrays.get(name) ?? { shape: [], data: null };
  const [frames = 0, joints, axes] = shape;
  if (joints !== 22 || axes !== 3 || !(data instanceof Float32Array))
    throw new Error(`${source}: ${name} should be float32 (T, 22, 3), is (${shape.join(', ')})`);
  return { fps: 30, frames, positions: data };
}

const { quality, audio } = JSON.parse(await readFile(manifest, 'utf8'));
await mkdir(folder, { recursive: true });
const song = arrays.get('song')?.data;
const beats = song instanceof Float32Array ? rhythmOf(song, audio).beats : [];
for (const name of arrays.keys()) {
  if (name === 'song') continue;
  const solved = solve(clip(name));
  const beside = name === 'reactor' && arrays.has('leader');
  const beatFrames = beats.map((seconds) => seconds * solved.fps);
  const steps = stepCounts(beatFrames, solved.frames, solved.fps);
  const motion = beside ? besidePartner(solved, clip('leader'), quality, steps) : solved;
  await writeFile(path.join(folder, `${name}.bvh`), writeBvh(motion));
  console.log(`${name}.bvh: ${motion.frames} frames, fit error ${(motion.fitError * 1000).toFixed(1)} mm`);
}
