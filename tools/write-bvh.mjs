// Solve joint positions with the page's own solver and write each as BVH:
//     node tools/write-bvh.mjs motions.npz folder
// motions.npz holds arrays NAME of (T, 22, 3) float32 metres at 30 fps; each becomes folder/NAME.bvh.
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { createServer } from 'vite';

const [source, folder] = process.argv.slice(2);
if (!source || !folder) throw new Error('usage: node tools/write-bvh.mjs motions.npz folder');

const vite = await createServer({
  server: { middlewareMode: true, watch: null, ws: false },
  appType: 'custom',
  logLevel: 'error',
});
try {
  const { readNpz } = await vite.ssrLoadModule('/model/npz.ts');
  const { solve } = await vite.ssrLoadModule('/motion/solve.ts');
  const { writeBvh } = await vite.ssrLoadModule('/motion/bvh-write.ts');
  await mkdir(folder, { recursive: true });
  for (const [name, array] of readNpz(new Uint8Array(await readFile(source)))) {
    const [frames, joints, axes] = array.shape;
    if (joints !== 22 || axes !== 3)
      throw new Error(`${name}: expected (T, 22, 3), got (${array.shape.join(', ')})`);
    const motion = solve({ fps: 30, frames, positions: array.data });
    await writeFile(path.join(folder, `${name}.bvh`), writeBvh(motion));
    console.log(`${name}.bvh: ${frames} frames, fit error ${(motion.fitError * 1000).toFixed(1)} mm`);
  }
} finally {
  await vite.close();
}
