/** C3D files that state little, or other than what they hold. */
import { describe, expect, test } from 'vitest';
import { readC3dFile } from '../../../../web/motion/import/c3d/file';
import { jointsOfMarkers } from '../../../../web/motion/import/c3d/plug-in-gait';
import { readLeaderFile } from '../../../../web/motion/import/read';
import type { Vec3 } from '../../../../web/motion/math/vec3';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import { writeC3d } from '../../support/motion-files/c3d';
import { madeMotion, type MadeMotion, worstMillimetres } from '../../support/motion-files/made-motion';

/** Millimetres by which joints made of markers are off. */
const WORST = 25;

const dance = madeMotion({ swing: 8 });
// No marker tells where a collar is.
const names = Object.fromEntries(
  Object.entries(dance.names).filter(([part]) => part !== 'collar'),
) as unknown as MadeMotion['names'];
const expected: MadeMotion = { ...dance, names };
const read = (bytes: Uint8Array): Promise<LeaderFile> => readLeaderFile([{ name: 'a.c3d', bytes }]);

describe('units', () => {
  test.each([
    ['cm', { unit: 'cm' }, 'cm'],
    ['inches', { unit: 'in' }, 'in'],
    ['millimetres in capitals', { unitName: 'MM' }, 'MM'],
    ['metres under a name that is not known', { unit: 'm', unitName: 'metre' }, 'metres'],
    ['metres without a name', { unit: 'm', unitName: '' }, 'metres'],
    ['metres that are called millimetres', { unit: 'm', unitName: 'mm' }, 'metres'],
    ['millimetres that are called metres', { unitName: 'm' }, 'millimetres'],
  ] as const)('%s', async (_name, options, unit) => {
    const file = await read(writeC3d(dance, options));
    expect(file.report.unit).toBe(unit);
    expect(worstMillimetres(file, expected)).toBeLessThan(WORST);
  });
});

test.each([
  ['in lower case', { relabel: (label: string) => label.toLowerCase() }],
  ['after a name and an underscore', { subject: 'Anna_' }],
])('labels %s', async (_name, options) => {
  expect(worstMillimetres(await read(writeC3d(dance, options)), expected)).toBeLessThan(WORST);
});

test('a marker at the origin was not seen, whatever its residual', async () => {
  const hidden = (label: string, frame: number): boolean => label === 'LKNE' && frame % 9 > 4;
  const file = await read(writeC3d(dance, { hidden, residual: 0 }));
  expect(worstMillimetres(file, expected)).toBeLessThan(WORST + 10);
});

test('a marker with a residual below 0 was not seen, wherever it is said to be', () => {
  const bytes = writeC3d(dance);
  const view = new DataView(bytes.buffer);
  const data = (view.getUint16(16, true) - 1) * 512;
  view.setFloat32(data + 12, -1, true);
  const { places } = readC3dFile(bytes);
  expect([...places.subarray(0, 3)]).toEqual([NaN, NaN, NaN]);
  expect(places.subarray(3, 6).some(Number.isNaN)).toBe(false);
});

test('what fills up the last block of a file of more than 65,535 frames is no frame', () => {
  const bytes = writeC3d(dance);
  new DataView(bytes.buffer).setUint16(8, 65_535, true);
  expect(readC3dFile(bytes)).toMatchObject({ frames: dance.frames, stated: null });
});

test('a file that is cut off says so', async () => {
  const bytes = writeC3d(dance);
  const file = await read(bytes.subarray(0, bytes.length - 6000));
  expect(file.clip.frames).toBeLessThan(dance.frames);
  expect(file.report.warnings).toEqual([
    `The file ends after ${file.clip.frames} of its 40 frames; these are used.`,
  ]);
  expect((await read(bytes)).report.warnings).toEqual([]);
});

test('markers without a label are no markers of the body', () => {
  const bytes = writeC3d(dance, { listed: 23, relabel: (label) => (label === 'CLAV' ? 'other' : label) });
  const text = Buffer.from(bytes).toString('latin1');
  expect(text).toContain('LABELS2');
  const fewer = bytes.slice();
  fewer[text.indexOf('LABELS2')] = 'X'.charCodeAt(0);
  const { labels } = readC3dFile(fewer);
  expect(labels).toEqual([...readC3dFile(bytes).labels.slice(0, 23), '*23']);
});

test('the frame rate is that of the parameters where the head states another one', () => {
  const bytes = writeC3d(dance);
  new DataView(bytes.buffer).setFloat32(20, 0, true);
  expect(readC3dFile(bytes).rate).toBe(30);
});

test('elbows of hanging arms are half their width inwards of their markers', () => {
  const side = (l: string, sign: number): [string, Vec3][] => [
    [`${l}ASI`, [sign * 0.12, 1, 0.1]],
    [`${l}PSI`, [sign * 0.05, 1, -0.1]],
    [`${l}KNE`, [sign * 0.15, 0.5, 0]],
    [`${l}ANK`, [sign * 0.15, 0.1, 0]],
    [`${l}TOE`, [sign * 0.1, 0.05, 0.15]],
    [`${l}SHO`, [sign * 0.2, 1.45, 0]],
    [`${l}ELB`, [sign * 0.245, 1.1, 0]],
    [`${l}FIN`, [sign * 0.2, 0.85, 0]],
  ];
  const markers = new Map<string, Vec3>([
    ...side('L', 1),
    ...side('R', -1),
    ['C7', [0, 1.5, -0.04]],
    ['CLAV', [0, 1.5, 0.06]],
  ]);
  const joints = jointsOfMarkers(
    (label) => markers.get(label)!,
    (label) => markers.has(label),
    1,
  );
  expect(joints.get('left_elbow')![0]).toBeCloseTo(0.2, 2);
  expect(joints.get('right_elbow')![0]).toBeCloseTo(-0.2, 2);
});

test('of two markers with one label the first is taken', async () => {
  const far = madeMotion({ swing: 40 });
  const bytes = writeC3d(dance, { beside: { subject: 'x', motion: far } });
  const text = Buffer.from(bytes).toString('latin1');
  const twice = bytes.slice();
  for (let at = text.indexOf('xLASI'); at >= 0 && text[at] === 'x'; at += 24)
    twice.set([...bytes.subarray(at + 1, at + 24), 32], at);
  const file = await read(twice);
  expect(file.report.parts).toEqual([]);
  expect(worstMillimetres(file, expected)).toBeLessThan(WORST);
});
