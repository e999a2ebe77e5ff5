/** NumPy files of all types of numbers, and rotations that look like joints. */
import { describe, expect, test } from 'vitest';
import { zipSync } from 'fflate';
import { readLeaderFile } from '../../../../web/motion/import/read';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import { SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { SMPL_NAMES, writeArchive } from '../../support/motion-files/arrays';
import { madeMotion, positionsOf, worstMillimetres } from '../../support/motion-files/made-motion';

const motion = madeMotion({ names: SMPL_NAMES });
const data = positionsOf(motion, SMPL22);
const read = (name: string, bytes: Uint8Array): Promise<LeaderFile> => readLeaderFile([{ name, bytes }]);

/** A .npy file of any type. @param write puts a value at a place */
function npyOf(
  type: string,
  shape: readonly number[],
  values: ArrayLike<number>,
  write: (view: DataView, at: number, value: number) => void,
  version = 1,
): Uint8Array {
  const size = Number(/\d+/.exec(type)?.[0] ?? 1);
  const list = shape.length === 1 ? `${shape[0]!},` : shape.join(', ');
  const header = `{'descr': '${type}', 'fortran_order': False, 'shape': (${list}), }\n`;
  const start = version === 1 ? 10 : 12;
  const view = new DataView(new ArrayBuffer(start + header.length + values.length * size));
  [...`\u0093NUMPY`].forEach((letter, at) => view.setUint8(at, letter.charCodeAt(0)));
  view.setUint8(6, version);
  if (version === 1) view.setUint16(8, header.length, true);
  else view.setUint32(8, header.length, true);
  [...header].forEach((letter, at) => view.setUint8(start + at, letter.charCodeAt(0)));
  for (let i = 0; i < values.length; i++) write(view, start + header.length + i * size, values[i]!);
  return new Uint8Array(view.buffer);
}

/** A float of two bytes for values of 2^-14 to 65,504, cut off. */
function setHalf(view: DataView, at: number, value: number): void {
  const exponent = value === 0 ? -15 : Math.max(-15, Math.floor(Math.log2(Math.abs(value))));
  const fraction = exponent < -14 ? Math.abs(value) * 2 ** 24 : (Math.abs(value) / 2 ** exponent - 1) * 1024;
  view.setUint16(at, (value < 0 ? 0x8000 : 0) | ((exponent + 15) << 10) | Math.trunc(fraction), true);
}

describe('types of numbers', () => {
  test.each([
    ['<f2', setHalf, 1, 2],
    ['>f4', (view: DataView, at: number, value: number) => view.setFloat32(at, value), 1, 0.05],
    ['>f8', (view: DataView, at: number, value: number) => view.setFloat64(at, value), 1, 0.05],
    ['<i2', (view: DataView, at: number, value: number) => view.setInt16(at, value, true), 1000, 2],
  ] as const)('joints as %s', async (type, write, perMetre, worst) => {
    const values = data.map((value) => value * perMetre);
    const file = await read('a.npy', npyOf(type, [40, 22, 3], values, write));
    expect(worstMillimetres(file, motion)).toBeLessThan(worst);
  });

  test.each([
    ['|u1', (view: DataView, at: number, value: number) => view.setUint8(at, value)],
    ['|i1', (view: DataView, at: number, value: number) => view.setInt8(at, value)],
    ['<u2', (view: DataView, at: number, value: number) => view.setUint16(at, value, true)],
    ['<u4', (view: DataView, at: number, value: number) => view.setUint32(at, value, true)],
    ['<u8', (view: DataView, at: number, value: number) => view.setBigUint64(at, BigInt(value), true)],
    ['<i8', (view: DataView, at: number, value: number) => view.setBigInt64(at, BigInt(value), true)],
    ['<f2', setHalf],
  ] as const)('a frame rate as %s', async (type, write) => {
    const joints = npyOf('<f4', [40, 22, 3], data, (view, at, value) => view.setFloat32(at, value, true));
    const bytes = zipSync({ 'joints.npy': joints, 'fps.npy': npyOf(type, [1], [60], write) });
    expect((await read('a.npz', bytes)).report).toMatchObject({ sourceFps: 60, remarks: [] });
  });

  test('a header of version 2', async () => {
    const bytes = npyOf('<f4', [40, 22, 3], data, (view, at, value) => view.setFloat32(at, value, true), 2);
    expect(worstMillimetres(await read('a.npy', bytes), motion)).toBeLessThan(0.05);
  });
});

describe('rotations', () => {
  const poses = Float32Array.from({ length: 40 * 66 }, (_, i) => 0.2 * Math.sin(i / 7 + (i % 66)));
  const trans = { shape: [40, 3], data: Float32Array.from({ length: 120 }, (_, i) => 0.01 * i) };
  const columns = (from: number, to: number): { shape: number[]; data: Float32Array } => ({
    shape: [40, to - from],
    data: poses.filter((_, i) => i % 66 >= from && i % 66 < to),
  });
  const hands = { shape: [40, 90], data: new Float32Array(3600).fill(0.1) };

  test('of the root, the body and the hands in arrays of their own', async () => {
    const whole = await read('a.npz', writeArchive({ poses: { shape: [40, 66], data: poses }, trans }));
    const parts = { root_orient: columns(0, 3), pose_body: columns(3, 66), pose_hand: hands, trans };
    const file = await read('a.npz', writeArchive(parts));
    expect(file.report).toEqual(whole.report);
    expect(file.clip.positions).toEqual(whole.clip.positions);
  });

  test('of the hands alone are no dancer', async () => {
    const bytes = writeArchive({ pose_hand: hands, trans });
    await expect(read('a.npz', bytes)).rejects.toMatchObject({ code: 'not-motion' });
  });

  test('that are called pose and have no place beside them', async () => {
    const pose = { shape: [40, 72], data: new Float32Array(40 * 72).map((_, i) => 0.2 * Math.sin(i / 7)) };
    const { report } = await read('a.npz', writeArchive({ pose }));
    expect(report.format).toContain('rotations');
  });

  test('with places for other frames, which are left out with a warning', async () => {
    const short = { shape: [39, 3], data: trans.data.subarray(0, 117) };
    const { report } = await read(
      'a.npz',
      writeArchive({ poses: { shape: [40, 66], data: poses }, trans: short }),
    );
    expect(report.warnings.join()).toContain("The body's place is (39, 3) for 40 frames");
  });
});

test('rotations of a body that lies so that up is not clear have z up, as AMASS does', async () => {
  const poses = new Float32Array(40 * 66).map((_, i) => (i % 66 === 0 ? Math.PI / 2 + 0.9 : 0));
  const { report } = await read('a.npz', writeArchive({ poses: { shape: [40, 66], data: poses } }));
  expect(report).toMatchObject({ upAxis: 'z', warnings: [expect.stringContaining('average adult')] });
});

test('an array of several values is no frame rate', async () => {
  const joints = { shape: [40, 22, 3], data };
  const fps = { shape: [2], data: Float64Array.of(60, 30) };
  const { report } = await read('a.npz', writeArchive({ joints, fps }));
  expect(report.sourceFps).toBe(30);
  expect(report.remarks).toEqual(['The file states no frame rate; 30 was taken.']);
});

test('an archive whose only array is damaged is called damaged', async () => {
  const bytes = zipSync({ 'joints.npy': new TextEncoder().encode('no array') });
  await expect(read('a.npz', bytes)).rejects.toMatchObject({ code: 'unreadable-file' });
});

test('joints whose bones change their lengths all the time are doubted', async () => {
  const grown = data.map((value, i) => value * (1 + 0.4 * Math.sin(Math.floor(i / 66) / 3)));
  const bytes = writeArchive({ joints: { shape: [40, 22, 3], data: grown } });
  expect((await read('a.npz', bytes)).report.warnings.join()).toContain('Bones change their lengths');
  const still = writeArchive({ joints: { shape: [40, 22, 3], data } });
  expect((await read('a.npz', still)).report.warnings).toEqual([]);
});

test('a pickled object is named', async () => {
  const bytes = npyOf('|O', [], [1, 2, 3], (view, at, value) => view.setUint8(at, value));
  await expect(read('a.npy', bytes)).rejects.toThrow('pickled Python object');
});
