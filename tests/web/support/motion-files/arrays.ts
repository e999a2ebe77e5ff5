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
    batch = false,
    up = 'y',
    unitsPerMetre = 1,
  }: { joints?: number; flat?: boolean; batch?: boolean; up?: 'y' | 'z'; unitsPerMetre?: number } = {},
): Uint8Array {
  const names = Array.from({ length: joints }, (_, joint) => SMPL22[joint] ?? null);
  const data = positionsOf(motion, names, unitsPerMetre, up);
  const shape = flat ? [motion.frames, joints * 3] : [motion.frames, joints, 3];
  return npyBytes({ shape: batch ? [1, ...shape] : shape, data });
}

/**
 * Where the body's joints are among those of the SOMA skeleton: trunk first, then from these indices on the arms and legs
 * of both sides; as NVIDIA's kimodo lists them.
 */
const SOMA_LIMBS = { 30: [10, 16, 22, 26], 77: [11, 39, 67, 72] } as const;

/** Names of a body of SOMA's joints. */
export const SOMA_NAMES: BodyNames = {
  root: 'Hips',
  spine: ['Spine1', 'Spine2', 'Chest'],
  neck: 'Neck1',
  head: 'Head',
  sides: ['Left', 'Right'],
  hip: '*Leg',
  knee: '*Shin',
  ankle: '*Foot',
  toe: '*ToeBase',
  collar: '*Shoulder',
  shoulder: '*Arm',
  elbow: '*ForeArm',
  wrist: '*Hand',
};

/** The motion of a body with `SOMA_NAMES` as (T, 30, 3) or (T, 77, 3). */
export function writeSomaNpy(motion: MadeMotion, count: 30 | 77): Uint8Array {
  const names = new Array<string | null>(count).fill(null);
  const trunk = ['Hips', 'Spine1', 'Spine2', 'Chest', 'Neck1', 'Neck1', 'Head'];
  trunk.forEach((name, at) => (names[at] = name));
  const limbs = [
    ['LeftShoulder', 'LeftArm', 'LeftForeArm', 'LeftHand'],
    ['RightShoulder', 'RightArm', 'RightForeArm', 'RightHand'],
    ['LeftLeg', 'LeftShin', 'LeftFoot', 'LeftToeBase'],
    ['RightLeg', 'RightShin', 'RightFoot', 'RightToeBase'],
  ];
  limbs.forEach((limb, i) => limb.forEach((name, step) => (names[SOMA_LIMBS[count][i]! + step] = name)));
  return npyBytes({ shape: [motion.frames, count, 3], data: positionsOf(motion, names) });
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
