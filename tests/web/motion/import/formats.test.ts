import { describe, expect, test } from 'vitest';
import { writeJson } from '../../../../web/export/json';
import { writeNpz } from '../../../../web/export/npz';
import { solve } from '../../../../web/motion/fit/ik';
import { type FileBytes, readLeaderFile } from '../../../../web/motion/import/read';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import type { ImportOptions } from '../../../../web/motion/retarget/options';
import { SMPL_NAMES, writeArchive, writeCsv, writeNpy } from '../../support/motion-files/arrays';
import {
  madeMotion,
  type MadeMotion,
  positionsOf,
  worstMillimetres,
} from '../../support/motion-files/made-motion';
import { SMPL22 } from '../../../../web/motion/skeleton/skeleton';

const utf8 = (text: string): Uint8Array => new TextEncoder().encode(text);

const read = (options: ImportOptions, ...files: [string, Uint8Array][]): Promise<LeaderFile> =>
  readLeaderFile(
    files.map(([name, bytes]): FileBytes => ({ name, bytes })),
    options,
  );

/** Largest error that is accepted, millimetres: the formats have single precision. */
const WORST = 0.05;

const joints = madeMotion({ names: SMPL_NAMES });

/** What the page exports of the made motion. */
function exported(motion: MadeMotion): Parameters<typeof writeNpz>[0] {
  const clip = { fps: 30, frames: motion.frames, positions: positionsOf(motion, SMPL22) };
  const solved = { ...solve(clip), positions: clip.positions };
  return {
    dancers: [
      { role: 'reactor', motion: { ...solved, positions: solved.positions.map((value) => -value) } },
      { role: 'leader', motion: solved },
    ],
    about: { song: null, leader: 'x', take: null, model: null, settings: {}, shift: 0, footLock: true },
  };
}

describe('arrays and tables of joints', () => {
  test.each([
    ['(T, 22, 3)', { joints: 22 }],
    ['(T, 55, 3)', { joints: 55 }],
    ['(T, 24, 3), z up', { joints: 24, up: 'z' as const }],
    ['flat, centimetres', { joints: 22, flat: true, unitsPerMetre: 100 }],
    ['flat (T, 165), z up', { joints: 55, flat: true, up: 'z' as const }],
  ])('NPY %s', async (_, options) => {
    const file = await read({}, ['a.npy', writeNpy(joints, options)]);
    expect(worstMillimetres(file, joints)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({
      format: 'NPY',
      convention: 'SMPL',
      upAxis: 'up' in options ? 'z' : 'y',
    });
    expect(file.report.remarks.join()).toContain('no frame rate');
  });

  test('NPZ with a frame rate and two dancers', async () => {
    const fast = madeMotion({ names: SMPL_NAMES, fps: 60, frames: 81 });
    const data = positionsOf(fast, SMPL22);
    const bytes = writeArchive({
      other: { shape: [81, 22, 3], data: data.map((value, i) => (i % 3 === 1 ? value : -value)) },
      leader: { shape: [81, 22, 3], data },
      fps: { shape: [], data: Float64Array.of(60) },
      joints: { shape: [22], data: SMPL22 },
    });
    const file = await read({}, ['a.npz', bytes]);
    expect(worstMillimetres(file, fast, 2)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ parts: ['leader', 'other'], part: 0, sourceFps: 60 });
    const other = await read({ part: 1 }, ['a.npz', bytes]);
    expect(worstMillimetres(other, fast, 2)).toBeGreaterThan(100);
  });

  test.each([
    ['npz', (motion: MadeMotion) => writeNpz(exported(motion))],
    ['json', (motion: MadeMotion) => utf8(writeJson(exported(motion)))],
  ])('%s as the page exports it', async (ending, write) => {
    const file = await read({}, [`a.${ending}`, write(joints)]);
    expect(file.report.parts).toEqual(['leader', 'reactor']);
    expect(worstMillimetres(file, joints)).toBeLessThan(0.1);
    expect(file.report.remarks).toEqual([]);
  });

  test.each([',', ';', '\t'])('CSV with %j', async (separator) => {
    const file = await read({}, ['a.csv', utf8(writeCsv(joints, separator, 'leader_'))]);
    expect(worstMillimetres(file, joints)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ sourceFps: 30, convention: 'SMPL' });
  });

  test('a wrong map shows as millimetres', async () => {
    const swapped = SMPL22.map((name) => name.replace(/^(left|right)_(elbow|wrist)$/, '$1_shoulder'));
    const data = positionsOf(joints, swapped);
    const file = await read({}, ['a.npz', writeArchive({ leader: { shape: [40, 22, 3], data } })]);
    expect(worstMillimetres(file, joints)).toBeGreaterThan(200);
  });
});
