import { readBvh } from '../../../web/motion/import/bvh/read';
import { type LeaderFile, leaderOf } from '../../../web/motion/retarget/leader';
import type { ImportOptions } from '../../../web/motion/retarget/options';

/** The dancer in the text of a BVH file. */
export function leaderBvh(text: string, options: ImportOptions = {}): LeaderFile {
  return leaderOf(readBvh(text, options.part), options);
}
