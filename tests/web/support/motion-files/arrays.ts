import { zipSync } from 'fflate';
import { npyBytes } from '../../../../web/export/npy';
import type { BodyNames } from '../made-bvh';
import { SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { type MadeMotion, positionsOf } from './made-motion';

/** A made body with exactly the 22 joints under their own names. */
export const SMPL_NAMES: BodyNames = {
  root: 'pelvis',
  spine: ['spine1', 'spine2', 'spine3'],
  neck: 'neck',
  head: 'head',
  sides: ['left', 'right'],
  hip: '*_hip',
  knee: '*_knee',
  ankle: '*_ankle',
  toe: '*_foot',
  collar: '*_collar',
  shoulder: '*_shoulder',
  elbow: '*_elbow',
  wrist: '*_wrist',
};

/** The motion as a .npy file: (T, 22, 3), more joints after them, or flat. */
export function writeNpy(
  motion: MadeMotion,
  {
    joints = 22,
    flat = false,
    up = 'y',
    unitsPerMetre = 1,
  }: { joints?: number; flat?: boolean; up?: 'y' | 'z'; unitsPerMetre?: number } = {},
): Uint8Array {
  const names = Array.from({ length: joints }, (_, joint) => SMPL22[joint] ?? null);
  const data = positionsOf(motion, names, unitsPerMetre, up);
  return npyBytes({ shape: flat ? [motion.frames, joints * 3] : [motion.frames, joints, 3], data });
}

/** An archive of arrays. */
export function writeArchive(files: Readonly<Record<string, Parameters<typeof npyBytes>[0]>>): Uint8Array {
  const packed = Object.entries(files).map(([name, array]) => [`${name}.npy`, npyBytes(array)] as const);
  return zipSync(Object.fromEntries(packed));
}

/** A table with a column for every joint and axis. */
export function writeCsv(motion: MadeMotion, separator = ',', prefix = ''): string {
  const titles = SMPL22.flatMap((name) => ['x', 'y', 'z'].map((axis) => `${prefix}${name}_${axis}`));
  const values = positionsOf(motion, SMPL22);
  const rows = Array.from({ length: motion.frames }, (_, frame) =>
    [frame / motion.fps, ...values.subarray(frame * 66, frame * 66 + 66)].join(separator),
  );
  return [['time', ...titles].join(separator), ...rows, ''].join('\n');
}
