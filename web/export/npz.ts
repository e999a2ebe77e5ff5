import { zipSync } from 'fflate';
import { JOINT_COUNT, SMPL22 } from '../motion/skeleton/skeleton';
import { type Dance, firstMotion, metadataOf } from './dance';
import { npyBytes } from './npy';

/** The date that NumPy gives its archives, so that the same motion gives the same file on every day. */
const ARCHIVE_DATE = new Date(1980, 0, 1);

/**
 * Joint positions as a NumPy archive: `reactor` and `leader` (T, 22, 3) float32 metres, as far as the dance has them; `fps`;
 * `joints`, their names; and `metadata`, JSON as text. Not compressed, as numpy.savez writes it.
 */
export function writeNpz(dance: Dance): Uint8Array<ArrayBuffer> {
  const { fps } = firstMotion(dance);
  const files: Record<string, Uint8Array> = {};
  for (const { role, motion } of dance.dancers)
    files[`${role}.npy`] = npyBytes({ shape: [motion.frames, JOINT_COUNT, 3], data: motion.positions });
  files['fps.npy'] = npyBytes({ shape: [], data: Float64Array.of(fps) });
  files['joints.npy'] = npyBytes({ shape: [JOINT_COUNT], data: SMPL22 });
  files['metadata.npy'] = npyBytes({ shape: [], data: [JSON.stringify(metadataOf(dance))] });
  return zipSync(files, { level: 0, mtime: ARCHIVE_DATE });
}
