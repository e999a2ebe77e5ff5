import type { Role } from '../common/role';
import { strToU8, zipSync } from 'fflate';
import { writeBvh } from '../motion/bvh/write';
import type { Dance } from './dance';

/** End of the file name. BVH holds one skeleton: one dancer is a BVH file, two are a ZIP archive with one each. */
export function bvhExtension(dancers: number): '.bvh' | '-bvh.zip' {
  return dancers > 1 ? '-bvh.zip' : '.bvh';
}

/**
 * The dance as BVH.
 *
 * @param now date of the files in an archive
 * @param nameOf file name of one dancer in an archive
 */
export function writeBvhFile(
  dance: Dance,
  now: Date,
  nameOf: (role: Role) => string,
): Uint8Array<ArrayBuffer> {
  const [first] = dance.dancers;
  if (first && dance.dancers.length === 1) return strToU8(writeBvh(first.motion));
  const files = dance.dancers.map(({ role, motion }) => [nameOf(role), strToU8(writeBvh(motion))] as const);
  return zipSync(Object.fromEntries(files), { level: 6, mtime: now });
}
