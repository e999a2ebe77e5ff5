import { parseManifest } from '../../../web/model/parse-manifest';
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { filesOf } from '../../../web/model/load/assets';
import { type Golden, readGolden } from '../../../web/model/load/golden';
import { GRAPHS, type GraphName, type Manifest } from '../../../web/model/manifest';
import { readNpz } from '../../../web/model/load/npz';
import type { NpzArray } from '../../../web/common/npz';
import type { Provider } from '../../../web/model/load/runtime';
import { type ModelSession, openSession } from '../../../web/model/load/session';

/** A model folder, opened in Node on the wasm runtime with one thread. */
export interface OpenedModel {
  readonly manifest: Manifest;
  readonly session: ModelSession;
  readonly golden: Golden;
  readonly arrays: Map<string, NpzArray>;
}

/**
 * @param provider whose files to take: WebGPU's are in single precision, so they agree with PyTorch to rounding; wasm's
 *   compute products in 8 bits
 */
export async function openModel(folder: URL, provider: Provider = 'webgpu'): Promise<OpenedModel> {
  const read = (path: string): Uint8Array => new Uint8Array(readFileSync(new URL(path, folder)));
  const manifest = parseManifest(JSON.parse(new TextDecoder().decode(read('manifest.json'))));
  const graphs = Object.fromEntries(
    GRAPHS.map((name) => [name, read(manifest.graphs[name].files[provider].path)]),
  ) as Record<GraphName, Uint8Array>;
  const session = await openSession(manifest, graphs, 'wasm', 1);
  const bytes = read(manifest.golden.path);
  return { manifest, session, golden: readGolden(bytes), arrays: readNpz(bytes) };
}

/** The paths of a model folder's files that are not as the manifest lists them. */
export function otherFiles(folder: URL, manifest: Manifest): string[] {
  return filesOf(manifest)
    .filter(({ path, bytes, sha256 }) => {
      const found = readFileSync(new URL(path, folder));
      return found.length !== bytes || createHash('sha256').update(found).digest('hex') !== sha256;
    })
    .map(({ path }) => path);
}

export const TINY = new URL('../../fixtures/tiny-model/', import.meta.url);

/** Largest absolute difference; NaN when lengths differ or a value is not a number. */
export function maxDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  if (a.length !== b.length) return NaN;
  let worst = 0;
  for (let i = 0; i < a.length; i++) worst = Math.max(worst, Math.abs((a[i] ?? NaN) - (b[i] ?? NaN)));
  return worst;
}
