import { describe, expect, test } from 'vitest';
import { zipSync } from 'fflate';
import { AppError } from '../../../../web/common/error';
import { readAmc } from '../../../../web/motion/import/amc/read';
import { readC3d } from '../../../../web/motion/import/c3d/read';
import { readFbx } from '../../../../web/motion/import/fbx/read';
import { readGltf } from '../../../../web/motion/import/gltf/read';
import { readNumpy } from '../../../../web/motion/import/numpy/read';
import { readMotion } from '../../../../web/motion/import/read';
import { readCsv } from '../../../../web/motion/import/tables/csv';
import { readJsonMotion } from '../../../../web/motion/import/tables/json';
import { readTrc } from '../../../../web/motion/import/tables/trc';
import { readVmd } from '../../../../web/motion/import/vmd/read';
import { leaderOf } from '../../../../web/motion/retarget/leader';
import type { MotionSource } from '../../../../web/motion/retarget/source';
import { SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { fuzz } from '../../support/hostile/fuzz';
import { processorTimer } from '../../support/processor-time';
import { damagedBytes, damagedText, MAX_CASE_SECONDS, type Random } from '../../support/hostile/mutations';
import { ASF_NAMES, writeAmc } from '../../support/motion-files/amc';
import { SMPL_NAMES, writeArchive, writeCsv, writeNpy } from '../../support/motion-files/arrays';
import { writeC3d } from '../../support/motion-files/c3d';
import { writeFbxAscii, writeFbxBinary } from '../../support/motion-files/fbx';
import { writeGlb } from '../../support/motion-files/glb';
import { madeMotion, positionsOf } from '../../support/motion-files/made-motion';
import { writeMotive, writeTrc } from '../../support/motion-files/markers';
import { writeVmd } from '../../support/motion-files/vmd';

const utf8 = (text: string): Uint8Array<ArrayBuffer> => new TextEncoder().encode(text);
const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);

const plain = madeMotion({ frames: 4 });
const joints = madeMotion({ names: SMPL_NAMES, frames: 4 });
const recording = writeAmc(madeMotion({ names: ASF_NAMES, frames: 20, fps: 120 }));
const data = positionsOf(joints, SMPL22);
const json = JSON.stringify({
  fps: 30,
  joints: SMPL22,
  positions: {
    leader: Array.from({ length: 4 }, (_, frame) =>
      Array.from({ length: 22 }, (_, joint) => [
        ...data.subarray((frame * 22 + joint) * 3, (frame * 22 + joint) * 3 + 3),
      ]),
    ),
  },
});
const amass = writeArchive({
  poses: { shape: [4, 72], data: new Float64Array(288).fill(0.01) },
  trans: { shape: [4, 3], data: new Float64Array(12) },
  mocap_framerate: { shape: [], data: Float64Array.of(30) },
});
const vmd = writeVmd([
  { bone: 'センター', frame: 0, move: [0, -1, 0] },
  { bone: '左足ＩＫ', frame: 6, move: [0, 1, 1] },
]);

const trc = writeTrc(
  joints.joints.map(({ name }) => name),
  joints.places,
  'm',
);

/** A file to damage, whether its text or its bytes are damaged, and its reader. */
const READERS: readonly (readonly [
  string,
  Uint8Array,
  'text' | 'bytes',
  (bytes: Uint8Array) => MotionSource,
])[] = [
  ['NPY', writeNpy(joints), 'bytes', (bytes) => readNumpy(bytes, 'a.npy', 0)],
  [
    'NPZ',
    writeArchive({ leader: { shape: [4, 22, 3], data } }),
    'bytes',
    (bytes) => readNumpy(bytes, 'a.npz', 0),
  ],
  ['AMASS', amass, 'bytes', (bytes) => readNumpy(bytes, 'a.npz', 0)],
  ['JSON', utf8(json), 'text', (bytes) => readJsonMotion(text(bytes), 0)],
  ['CSV', utf8(writeCsv(joints)), 'text', (bytes) => readCsv(text(bytes), 0)],
  ['CSV of Motive', utf8(writeMotive({ Anna: plain })), 'text', (bytes) => readCsv(text(bytes), 0)],
  ['TRC', utf8(trc), 'text', (bytes) => readTrc(text(bytes))],
  ['FBX, binary', writeFbxBinary(plain), 'bytes', (bytes) => readFbx(bytes, 0)],
  ['FBX, text', writeFbxAscii(plain), 'text', (bytes) => readFbx(bytes, 0)],
  ['GLB', writeGlb(plain), 'bytes', (bytes) => readGltf([{ name: 'a.glb', bytes }], 0)],
  ['VMD', vmd, 'bytes', readVmd],
  ['C3D', writeC3d(plain), 'bytes', (bytes) => readC3d(bytes, 0)],
  [
    'AMC',
    recording.amc,
    'text',
    (bytes) =>
      readAmc([
        { name: 'a.amc', bytes },
        { name: 'a.asf', bytes: recording.asf },
      ]),
  ],
  [
    'ASF',
    recording.asf,
    'text',
    (bytes) =>
      readAmc([
        { name: 'a.amc', bytes: recording.amc },
        { name: 'a.asf', bytes },
      ]),
  ],
];

test.each(READERS)(
  'a damaged file is read as a possible dance or refused in a sentence: %s',
  { timeout: 600_000 },
  (_name, bytes, kind, read) => {
    const plainText = kind === 'text' ? text(bytes) : '';
    const damage = (random: Random): Uint8Array =>
      kind === 'text' ? utf8(damagedText(plainText, random)) : damagedBytes(bytes, random);
    expect(leaderOf(read(bytes)).clip.frames).toBeGreaterThan(1);
    const { read: accepted, refused } = fuzz(
      damage,
      (damaged) => leaderOf(read(damaged)).clip,
      ({ frames, positions }) => {
        expect(frames).toBeGreaterThan(1);
        expect(positions.every((value) => Math.abs(value) <= 53)).toBe(true);
      },
    );
    expect(Math.min(accepted, refused)).toBeGreaterThan(0);
  },
);

describe('absurd files', () => {
  const problemOf = (read: () => unknown): AppError => {
    const seconds = processorTimer();
    try {
      read();
    } catch (error) {
      expect(seconds()).toBeLessThan(2 * MAX_CASE_SECONDS);
      if (error instanceof AppError) return error;
      throw error;
    }
    throw new Error('the file was read');
  };

  test('a file of more than 512 MB, and one of no known format', async () => {
    const large = { name: 'a.bvh', bytes: new Uint8Array(512 * 1024 ** 2 + 1) };
    await expect(readMotion([large])).rejects.toMatchObject({ code: 'too-large' });
    const other = { name: 'a.txt', bytes: utf8('words') };
    await expect(readMotion([other])).rejects.toMatchObject({ code: 'not-motion' });
  });

  test('an archive that unpacks to gigabytes', () => {
    const zeros = zipSync({ 'leader.npy': new Uint8Array(1e6) });
    const entry = zeros.findIndex((_, at) => [0x50, 0x4b, 1, 2].every((byte, i) => zeros[at + i] === byte));
    new DataView(zeros.buffer).setUint32(entry + 24, 4e9, true);
    expect(problemOf(() => readNumpy(zeros, 'a.npz', 0)).message).toMatch(/more than 256 MB/);
  });

  test('nodes of glTF and FBX in a circle, and a million deep', () => {
    const circle = {
      asset: { version: '2.0' },
      nodes: [{ children: [1] }, { children: [0] }],
      accessors: [],
      animations: [],
    };
    const looped = {
      ...circle,
      animations: [{ samplers: [], channels: [{ sampler: 0, target: { path: 'rotation' } }] }],
    };
    expect(
      problemOf(() => readGltf([{ name: 'a.gltf', bytes: utf8(JSON.stringify(looped)) }], 0)).message,
    ).toMatch(/circle/);
    const deep = utf8(`; FBX 7.4.0\n${'Model: 1 {\n'.repeat(1e6)}`);
    expect(problemOf(() => readFbx(deep, 0)).message).toMatch(/more than 32 deep/);
    const models =
      '; FBX 7.4.0\nObjects: {\nModel: 1, "Model::a", "LimbNode" {\n}\nModel: 2, "Model::b", "LimbNode" {\n}\n}\n';
    const links = 'Connections: {\nC: "OO",1,2\nC: "OO",2,1\n}\n';
    expect(problemOf(() => readFbx(utf8(models + links), 0)).message).toMatch(/circle/);
  });

  test('20,000 joints', () => {
    const many = {
      asset: { version: '2.0' },
      nodes: Array.from({ length: 20_000 }, () => ({})),
      animations: [{ samplers: [], channels: [{ sampler: 0, target: { path: 'rotation' } }] }],
    };
    expect(
      problemOf(() => readGltf([{ name: 'a.gltf', bytes: utf8(JSON.stringify(many)) }], 0)).message,
    ).toMatch(/20000 nodes/);
  });

  test('a key after a year, and coordinates of kilometres', () => {
    const late = writeVmd([
      { bone: 'センター', frame: 0 },
      { bone: 'センター', frame: 1e9 },
    ]);
    expect(problemOf(() => readVmd(late)).code).toBe('too-long');
    const refused = (far: Float32Array) => {
      const archive = writeArchive({ leader: { shape: [4, 22, 3], data: far } });
      return problemOf(() => leaderOf(readNumpy(archive, 'a.npz', 0)));
    };
    const away = data.slice();
    away[66 * 3] = 4000;
    expect(refused(away).code).toBe('not-a-body');
    expect(refused(away).hint).toMatch(/wrong frames/);
    const aside = refused(data.map((value, i) => (i % 3 === 0 ? value + 80 : value)));
    expect(aside.message).toMatch(/^The dance is too far aside: .* in frame 1 is more than 50 m/);
    expect(aside.hint).toMatch(/middle of the scene/);
  });

  test('markup in names stays text', () => {
    const motion = {
      ...plain,
      joints: plain.joints.map((joint, i) => ({
        ...joint,
        name: i > 0 ? joint.name : '<img src=x onerror=alert(1)>',
      })),
    };
    expect(leaderOf(readGltf([{ name: 'a.glb', bytes: writeGlb(motion) }], 0)).clip.frames).toBe(4);
  });
});
