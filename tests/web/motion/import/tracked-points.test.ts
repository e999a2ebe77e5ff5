/** Tables of points and markers over time: FreeMoCap, MediaPipe, COCO, Pose2Sim, OpenSim, Motive. */
import { describe, expect, test } from 'vitest';
import { npyBytes } from '../../../../web/export/npy';
import { withoutGaps } from '../../../../web/motion/import/gaps';
import { readLeaderFile } from '../../../../web/motion/import/read';
import { readCsv } from '../../../../web/motion/import/tables/csv';
import { readTrc } from '../../../../web/motion/import/tables/trc';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import type { ImportOptions } from '../../../../web/motion/retarget/options';
import { CONVENTIONS } from '../../support/motion-files/conventions';
import { rowsOf, seen, seenParts, seenWithoutToes } from '../../support/motion-files/landmarks';
import { madeMotion, worstMillimetres } from '../../support/motion-files/made-motion';
import { writeMotive, writeTrc } from '../../support/motion-files/markers';

const WORST = 0.1;
const both = (...parts: string[]): string[] => parts.flatMap((part) => [`left_${part}`, `right_${part}`]);
const read = (name: string, content: string | Uint8Array, options: ImportOptions = {}): Promise<LeaderFile> =>
  readLeaderFile(
    [{ name, bytes: typeof content === 'string' ? new TextEncoder().encode(content) : content }],
    options,
  );

const FACE = ['nose', ...both('eye', 'ear')];
const LIMBS = both('shoulder', 'elbow', 'wrist', 'hip', 'knee', 'ankle');
const MEDIAPIPE = [...FACE, ...LIMBS, ...both('foot_index')];

/** A table as FreeMoCap writes it. */
function table(
  points: readonly string[],
  { before = '', unit = 1000, up = 'z' }: { before?: string; unit?: number; up?: 'y' | 'z' } = {},
): string {
  const titles = points.flatMap((name) => [...'xyz'].map((axis) => `${before}${name}_${axis}`));
  const rows = rowsOf(points, unit, up).map((row) => row.flat().join(','));
  return [titles.join(','), ...rows].join('\n');
}

test("a joint that was never seen is left out, and is nobody's parent", () => {
  const joints = ['lost', 'hip', 'knee', 'ankle'].map((name, i) => ({ name, parent: i - 1 }));
  const places = Float32Array.from([NaN, NaN, NaN, 1, 1, 1, 2, 2, 2, 3, 3, 3]);
  const closed = withoutGaps({ joints, places });
  expect(closed.joints.map(({ name, parent }) => [name, parent])).toEqual([
    ['hip', -1],
    ['knee', 0],
    ['ankle', 1],
  ]);
  expect([...closed.places]).toEqual([1, 1, 1, 2, 2, 2, 3, 3, 3]);
});

describe('points that are seen in pictures', () => {
  test.each(['', 'body_'])('a table of FreeMoCap whose names begin with %j', async (before) => {
    const file = await read('mediapipe_body_3d_xyz.csv', table(MEDIAPIPE, { before }));
    expect(worstMillimetres(file, seenParts)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({
      convention: 'pose landmarks',
      unit: 'millimetres',
      upAxis: 'z',
      warnings: [],
    });
    expect(file.report.estimated).not.toContain('left_foot');
  });

  test('hands, a face and a centre of mass beside the body are left out', async () => {
    const others = ['com_full_body', 'right_hand_0000', 'left_hand_0000', 'face_0000'];
    const titles = others.flatMap((name) => [...'xyz'].map((axis) => `${name}_${axis}`)).join(',');
    const text = table(MEDIAPIPE, { before: 'body_' })
      .split('\n')
      .map(
        (line, row) =>
          `${row === 0 ? 'timestamp' : ''},${line},${row === 0 ? titles : '1,'.repeat(11) + '1'}`,
      )
      .join('\n');
    const file = await read('recording_by_trajectory.csv', text);
    expect(worstMillimetres(file, seenParts)).toBeLessThan(WORST);
  });

  test('a table with a line for every point is refused, and the right one named', async () => {
    const text = 'frame,timestamp,model,keypoint,x,y,z,reprojection_error\n0,,body,nose,1,2,3,0.1\n';
    await expect(read('recording_by_frame.csv', text)).rejects.toMatchObject({
      code: 'not-motion',
      hint: expect.stringContaining('mediapipe_body_3d_xyz.csv') as string,
    });
  });

  test('a skeleton that has a spine beside a nose keeps its own neck and head', async () => {
    const names = [...MEDIAPIPE, 'spine1', 'neck', 'head'];
    const { report } = await read('a.csv', table(names));
    expect(report.convention).not.toBe('pose landmarks');
    expect(report.joints).toMatchObject({ neck: 'neck', head: 'head' });
  });

  test('gaps are closed, and named where they are many', async () => {
    const column = MEDIAPIPE.indexOf('left_wrist') * 3;
    const withGap = (from: number, to: number, points: number): string =>
      table(MEDIAPIPE)
        .split('\n')
        .map((line, row) =>
          line
            .split(',')
            .map((cell, i) =>
              row > from && row <= to && i >= column && i < column + 3 * points
                ? row % 2
                  ? ''
                  : 'nan'
                : cell,
            )
            .join(','),
        )
        .join('\n');
    const short = await read('a.csv', withGap(10, 12, 1));
    expect(worstMillimetres(short, seenParts)).toBeLessThan(10);
    expect(short.report.warnings).toEqual([]);
    const long = await read('a.csv', withGap(30, 40, 4));
    expect(long.report.warnings.join()).toMatch(/^5 % of the places in this file are missing/);
  });

  const H36M = [
    'middle',
    ...['right', 'left'].flatMap((side) => ['hip', 'knee', 'ankle'].map((part) => `${side}_${part}`)),
  ];
  const orders: [string, number, (string | null)[]][] = [
    ['COCO', 17, [...FACE, ...LIMBS]],
    [
      'Human3.6M',
      17,
      [
        ...H36M,
        'spine1',
        'neck',
        'nose',
        'top',
        ...['left', 'right'].flatMap((side) =>
          ['shoulder', 'elbow', 'wrist'].map((part) => `${side}_${part}`),
        ),
      ],
    ],
    ['COCO with all', 133, [...FACE, ...LIMBS, 'left_toe', null, null, 'right_toe']],
    ...[33, 553].map((count): [string, number, (string | null)[]] => [
      'MediaPipe',
      count,
      [
        ...['nose', ...Array<string>(6).fill('left_eye'), ...both('ear'), ...both('mouth')],
        ...LIMBS.slice(0, 6),
        ...Array<null>(6).fill(null),
        ...LIMBS.slice(6),
        null,
        null,
        ...both('foot_index'),
      ],
    ]),
  ];
  test.each(orders)('%s as an array of %i points', async (_, count, points) => {
    const all = Array.from({ length: count }, (_, i) => points[i] ?? null);
    const data = Float32Array.from(rowsOf(all, 100).flat(2));
    const file = await read('a.npy', npyBytes({ shape: [seen.frames, count, 3], data }));
    // COCO and Human3.6M have no toes.
    expect(worstMillimetres(file, count === 17 ? seenWithoutToes : seenParts)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ unit: 'centimetres', convention: 'pose landmarks', warnings: [] });
  });

  test.each([[[33, 4]], [[33 * 4]]])('MediaPipe with how sure each point is, frames x %j', async (sizes) => {
    const points = Array.from({ length: 33 }, (_, i) => orders.at(-1)![2][i] ?? null);
    const data = Float32Array.from(rowsOf(points, 100).flatMap((row) => row.flatMap((at) => [...at, 0.9])));
    const file = await read('a.npy', npyBytes({ shape: [seen.frames, ...sizes], data }));
    expect(worstMillimetres(file, seenParts)).toBeLessThan(WORST);
    expect(file.report.convention).toBe('pose landmarks');
  });

  test.each([
    ['{"version":1.3,"people":[{"person_id":[-1],"pose_keypoints_2d":[582.3,507.8,0.84]}]}'],
    ['[{"image_id":"0.jpg","category_id":1,"keypoints":[582.3,507.8,0.84]}]'],
  ])('JSON of OpenPose and AlphaPose is refused with the reason (%#)', async (json) => {
    await expect(read('0.json', json)).rejects.toMatchObject({
      code: 'not-motion',
      message: expect.stringContaining('without depth') as string,
    });
  });

  test('points in a picture with how sure each is are refused', async () => {
    const rows = rowsOf([...FACE, ...LIMBS], 400).map((row) => row.map(([x, y]) => [x, y, 0.9]));
    const data = Float32Array.from(rows.flat(2));
    const bytes = npyBytes({ shape: [seen.frames, 17, 3], data });
    await expect(read('a.npy', bytes)).rejects.toMatchObject({
      code: 'not-motion',
      message: expect.stringContaining('no depth') as string,
    });
  });
});

describe('TRC', () => {
  const short = (name: string): string =>
    name.replace(
      /^(left|right)_(.)/,
      (_, side: string, first: string) => side[0]!.toUpperCase() + first.toUpperCase(),
    );
  const points = [...LIMBS, ...both('big_toe'), 'neck', 'top', 'nose'];
  const names = points.map((name) => ({ top: 'Head', neck: 'Neck', nose: 'Nose' })[name] ?? short(name));

  test('markers of Pose2Sim', async () => {
    const file = await read(
      'dance.trc',
      writeTrc(
        names.map((name) => name.replace('Big_toe', 'BigToe')),
        rowsOf(points),
        'm',
      ),
    );
    expect(worstMillimetres(file, seenParts, 2)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({
      format: 'TRC',
      sourceFps: 60,
      unit: 'metres',
      upAxis: 'y',
      warnings: [],
    });
  });

  test('joints, with a gap', async () => {
    const joints = seen.joints.map(({ name }) => name);
    const text = writeTrc(joints, rowsOf(joints, 1000), 'mm').replace(
      /^(9\t[^\t]*\t)[^\t]*\t[^\t]*\t[^\t]*/m,
      '$1\t\t',
    );
    const file = await read('dance.trc', text);
    expect(worstMillimetres(file, seen, 2)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ unit: 'millimetres', convention: 'SMPL' });
  });

  test.each([
    ['mm', 'millimetres'],
    ['Meters', 'metres'],
    ['furlongs', undefined],
  ])('the unit is the stated one: %s', (word, name) => {
    const { unit } = readTrc(writeTrc(['a'], [[[1, 2, 3]], [[1, 2, 3]]], word));
    expect(unit?.name).toBe(name);
  });

  test.each([
    [(text: string) => text.replace(/^Frame#.*$/m, 'Frame#\tTime'), 'names no markers'],
    [(text: string) => text.replace(/^(7\t[^\t]*\t)[^\t]*/m, '$1abc'), '"abc" in frame 7 is not a number'],
  ])('damage is named (%#)', async (damage, message) => {
    const joints = seen.joints.map(({ name }) => name);
    await expect(read('dance.trc', damage(writeTrc(joints, rowsOf(joints), 'm')))).rejects.toMatchObject({
      code: 'unreadable-file',
      message: expect.stringContaining(message) as string,
    });
  });
});

describe('tables of Motive', () => {
  const { names } = CONVENTIONS.find(({ label }) => label === 'OptiTrack, older')!;
  const [anna, bob] = [
    madeMotion({ names, fps: 60, frames: 81 }),
    madeMotion({ names, fps: 60, frames: 81, swing: 25 }),
  ];

  test('bones of one skeleton', async () => {
    const file = await read('Take 2024.csv', writeMotive({ Anna: anna }));
    expect(worstMillimetres(file, anna, 2)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({
      convention: 'OptiTrack',
      unit: 'millimetres',
      sourceFps: 60,
      parts: [],
    });
  });

  test('the unit is the stated one', () => {
    const text = writeMotive({ Anna: anna });
    expect(readCsv(text, 0).unit?.name).toBe('millimetres');
    expect(readCsv(text.replace('Millimeters', 'Centimeters'), 0).unit?.name).toBe('centimetres');
  });

  test('one of two skeletons', async () => {
    const text = writeMotive({ Anna: anna, Bob: bob });
    const file = await read('Take 2024.csv', text, { part: 1 });
    expect(file.report).toMatchObject({ parts: ['Anna', 'Bob'], part: 1 });
    expect(worstMillimetres(file, bob, 2)).toBeLessThan(WORST);
  });

  test.each([
    [writeMotive({ Anna: anna }, 'Local'), 'within one another'],
    [writeMotive({ Anna: anna }).replaceAll(/\bBone,/g, 'Rigid Body,'), 'holds no bones'],
  ])('what cannot be used is said (%#)', async (text, message) => {
    await expect(read('a.csv', text)).rejects.toMatchObject({
      code: 'not-motion',
      message: expect.stringContaining(message) as string,
    });
  });
});
