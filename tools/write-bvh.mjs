/**
 * Solves joint positions as the page does and writes each as BVH.
 *
 *     node tools/write-bvh.mjs motions.npz folder
 *
 * motions.npz holds arrays NAME of (T, 22, 3) float32 metres at 30 fps; each becomes folder/NAME.bvh.
 */
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { loadWeb } from './load-web.mjs';

const [source, folder] = process.argv.slice(2);
if (!source || !folder) {
  console.error('Usage: node tools/write-bvh.mjs motions.npz folder');
  process.exit(2);
}

/** @type {typeof import('../web/model/npz')} */
const { readNpz } = await loadWeb('model/npz.ts');
/** @type {typeof import('../web/motion/solve')} */
const { solve } = await loadWeb('motion/solve.ts');
/** @type {typeof import('../web/motion/bvh-write')} */
const { writeBvh } = await loadWeb('motion/bvh-write.ts');

await mkdir(folder, { recursive: true });
for (const [name, array] of readNpz(new Uint8Array(await readFile(source)))) {
  const [frames = 0, joints, axes] = array.shape;
  if (joints !== 22 || axes !== 3 || !(array.data instanceof Float32Array))
    throw new Error(`${name}: expected float32 (T, 22, 3), got (${array.shape.join(', ')})`);
  const motion = solve({ fps: 30, frames, positions: array.data });
  await writeFile(path.join(folder, `${name}.bvh`), writeBvh(motion));
  console.log(`${name}.bvh: ${frames} frames, fit error ${(motion.fitError * 1000).toFixed(1)} mm`);
}
