/** Puts another version of the built page in the place of the one in a folder. */
import { readdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { writeServiceWorker } from '../../../tools/vite/service-worker.mjs';

const TEXT = /\.(css|html|js)$/;

/** Renames all files of assets/ wherever they are named, as a build of other sources has other hashes. */
export async function deployOtherVersion(root: string): Promise<void> {
  const assets = path.join(root, 'assets');
  const names = readdirSync(assets);
  const renamed = new Map(names.map((name) => [name, name.replace(/(\.[a-z0-9]+)$/, 'x$1')]));
  const texts = [path.join(root, 'index.html'), ...names.map((name) => path.join(assets, name))];
  for (const file of texts.filter((name) => TEXT.test(name))) {
    let text = readFileSync(file, 'utf8');
    for (const [old, next] of renamed) text = text.replaceAll(old, next);
    writeFileSync(file, text);
  }
  for (const [old, next] of renamed) renameSync(path.join(assets, old), path.join(assets, next));
  await writeServiceWorker(root);
}
