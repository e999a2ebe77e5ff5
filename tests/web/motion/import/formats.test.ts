import { strToU8, unzipSync, zipSync } from 'fflate';
import { AnimationMixer, Vector3 } from 'three';
import { FBXLoader } from 'three/addons/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { describe, expect, test } from 'vitest';
import { readFbx } from '../../../../web/motion/import/fbx/read';
import { readGltf } from '../../../../web/motion/import/gltf/read';
import { aboutAxis, multiply, rotate } from '../../../../web/motion/math/quat';
import {
  add,
  cross,
  direction,
  distance,
  dot,
  readVec,
  scale,
  sub,
  type Vec3,
  X_AXIS,
  Y_AXIS,
  ZERO,
} from '../../../../web/motion/math/vec3';
import { changedGlb, joinClips, joinedGlb, writeGlb, writeGltf } from '../../support/motion-files/glb';
import { CONVENTIONS } from '../../support/motion-files/conventions';
import { madeBody, MIXAMO } from '../../support/made-bvh';
import { worldPose } from '../../../../web/motion/retarget/sample';
import { writeFbxAscii, writeFbxBinary, writeFbxDuet } from '../../support/motion-files/fbx';
import { writeJson } from '../../../../web/export/json';
import { writeNpz } from '../../../../web/export/npz';
import { solve } from '../../../../web/motion/fit/ik';
import { type FileBytes, readLeaderFile } from '../../../../web/motion/import/read';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import type { ImportOptions } from '../../../../web/motion/retarget/options';
import {
  SMPL_NAMES,
  SOMA_NAMES,
  writeArchive,
  writeCsv,
  writeNpy,
  writeSomaNpy,
} from '../../support/motion-files/arrays';
import {
  madeMotion,
  type MadeMotion,
  positionsOf,
  worstMillimetres,
} from '../../support/motion-files/made-motion';
import { J, JOINT_COUNT, SMPL22 } from '../../../../web/motion/skeleton/skeleton';

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
    ['(T, 52, 3)', { joints: 52 }],
    ['(T, 127, 3)', { joints: 127 }],
    ['(T, 144, 3)', { joints: 144 }],
    ['(1, T, 22, 3)', { joints: 22, batch: true }],
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
    // The trunk is that of the file.
    expect(file.report.estimated).toEqual([]);
    const made = (name: string): Vec3 =>
      joints.places[20]![joints.joints.findIndex((one) => one.name === name)]!;
    const at = (joint: number): Vec3 => readVec(file.clip.positions, 20 * JOINT_COUNT + joint);
    const back = sub(at(J.spine2), at(J.pelvis));
    expect(distance(back, sub(made('spine2'), made('pelvis')))).toBeLessThan(1e-5);
  });

  test('a frame rate that is set is not remarked on', async () => {
    const { report } = await read({ fps: 60 }, ['a.npy', writeNpy(joints)]);
    expect(report).toMatchObject({ sourceFps: 60, remarks: [] });
  });

  test('where a lying body leaves it open, up is guessed, with a warning, unless it is set', async () => {
    const places = joints.places.map((row) => row.map((place) => rotate(aboutAxis(X_AXIS, 0.9), place)));
    const table = utf8(writeCsv({ ...joints, places }));
    const doubt = 'It is not clear which way is up; z was taken.';
    expect((await read({}, ['a.csv', table])).report).toMatchObject({ upAxis: 'z', warnings: [doubt] });
    const set = await read({ up: 'y' }, ['a.csv', table]);
    expect(set.report).toMatchObject({ upAxis: 'y', warnings: [] });
  });

  test.each([30, 77] as const)('NPY (T, %i, 3) of SOMA', async (count) => {
    const soma = madeMotion({ names: SOMA_NAMES });
    const file = await read({}, ['a.npy', writeSomaNpy(soma, count)]);
    expect(worstMillimetres(file, soma)).toBeLessThan(WORST);
    expect(file.report.convention).toBe('SOMA');
  });

  test.each(['fps', 'mocap_framerate'])('NPZ states its frame rate as %s', async (name) => {
    const fast = madeMotion({ names: SMPL_NAMES, fps: 120, frames: 121 });
    const bytes = writeArchive({
      joints: { shape: [121, 22, 3], data: positionsOf(fast, SMPL22) },
      [name]: { shape: [], data: Float64Array.of(120) },
    });
    const file = await read({}, ['a.npz', bytes]);
    expect(worstMillimetres(file, fast, 4)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ sourceFps: 120, remarks: [] });
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

  test('NPZ whose leader has a gap: the joint lies between the places before and after', async () => {
    const data = positionsOf(joints, SMPL22);
    const shape = [40, 22, 3];
    const lost = (frame: number, joint: number): boolean => joint === 20 && frame >= 10 && frame < 30;
    const gap = data.map((value, i) => (lost(Math.floor(i / 66), Math.floor(i / 3) % 22) ? NaN : value));
    const between = data.map((value, i) => {
      const [frame, column] = [Math.floor(i / 66), i % 66];
      if (!lost(frame, Math.floor(column / 3))) return value;
      const [from, to] = [data[9 * 66 + column]!, data[30 * 66 + column]!];
      return from + ((to - from) * (frame - 9)) / 21;
    });
    const fps = { shape: [], data: Float64Array.of(30) };
    const bridged = await read({}, ['a.npz', writeArchive({ joints: { shape, data: gap }, fps })]);
    const whole = await read({}, ['a.npz', writeArchive({ joints: { shape, data: between }, fps })]);
    const apart = bridged.clip.positions.map((value, i) => Math.abs(value - whole.clip.positions[i]!));
    expect(Math.max(...apart)).toBeLessThan(1e-6);
    expect(bridged.report.warnings.join()).toMatch(/2 % of the places in this file are missing/);
  });

  test('NPZ whose leader has an infinite value is refused, and never another dancer read for him', async () => {
    const data = positionsOf(joints, SMPL22);
    const shape = [40, 22, 3];
    const broken = { shape, data: data.map((value, i) => (i === 100 ? Infinity : value)) };
    const fps = { shape: [], data: Float64Array.of(30) };
    const couple = writeArchive({ leader: broken, follower: { shape, data }, fps });
    await expect(read({}, ['a.npz', couple])).rejects.toThrow(/not a finite number/);
    expect(worstMillimetres(await read({ part: 1 }, ['a.npz', couple]), joints)).toBeLessThan(WORST);
    const alone = writeArchive({ joints: broken, fps });
    await expect(read({}, ['a.npz', alone])).rejects.toThrow(/not a finite number/);
  });

  test('NPZ with a mask, a text and a frame rate of another type beside the joints', async () => {
    const data = positionsOf(joints, SMPL22);
    const files = unzipSync(writeArchive({ joints: { shape: [40, 22, 3], data } }));
    const ofType = (type: string, shape: string, size: number): Uint8Array => {
      const header = strToU8(`{'descr': '${type}', 'fortran_order': False, 'shape': ${shape}, }`);
      return Uint8Array.of(
        ...strToU8('\u0093NUMPY', true),
        1,
        0,
        header.length,
        0,
        ...header,
        ...new Uint8Array(size),
      );
    };
    const bytes = zipSync({
      'a_valid.npy': ofType('|b1', '(40, 22, 3)', 2640),
      'fps.npy': ofType('<c8', '()', 8),
      'about.json': strToU8('{}'),
      ...files,
    });
    const file = await read({}, ['a.npz', bytes]);
    expect(worstMillimetres(file, joints)).toBeLessThan(WORST);
    expect(file.report.remarks.join()).toContain('no frame rate');
  });

  test('NPZ whose joints are named poses, without a place beside them', async () => {
    const poses = { shape: [40, 22, 3], data: positionsOf(joints, SMPL22) };
    expect(worstMillimetres(await read({}, ['a.npz', writeArchive({ poses })]), joints)).toBeLessThan(WORST);
  });

  test.each([
    ['(T, 24, 3)', [40, 24, 3]],
    ['(1, T, 24, 3)', [1, 40, 24, 3]],
  ])('NPZ with rotations as %s, and with the place in the unit of AIST++', async (_, shape) => {
    const data = Float32Array.from({ length: 40 * 72 }, (_, i) => 0.2 * Math.sin(i % 72));
    const trans = Float32Array.from({ length: 40 * 3 }, (_, i) => 0.01 * i);
    const flat = writeArchive({
      poses: { shape: [40, 72], data },
      trans: { shape: [40, 3], data: trans },
    });
    const scaled = writeArchive({
      smpl_poses: { shape, data },
      smpl_trans: { shape: [40, 3], data: trans.map((value) => value * 93.7) },
      smpl_scaling: { shape: [1], data: Float64Array.of(93.7) },
    });
    const [expected, file] = [await read({}, ['a.npz', flat]), await read({}, ['a.npz', scaled])];
    expect(file.report).toEqual(expected.report);
    file.clip.positions.forEach((value, i) => expect(value).toBeCloseTo(expected.clip.positions[i]!, 5));
  });

  test.each([
    ['npz', (motion: MadeMotion) => writeNpz(exported(motion))],
    ['json', (motion: MadeMotion) => utf8(writeJson(exported(motion)))],
  ])('%s as the page exports it', async (ending, write) => {
    const file = await read({}, [`a.${ending}`, write(joints)]);
    expect(file.report.parts).toEqual(['leader', 'reactor']);
    expect(worstMillimetres(file, joints)).toBeLessThan(0.1);
    expect(file.report.remarks).toHaveLength(1);
  });

  test.each([',', ';', '\t'])('CSV with %j', async (separator) => {
    const file = await read({}, ['a.csv', utf8(writeCsv(joints, separator, 'leader_'))]);
    expect(worstMillimetres(file, joints)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ sourceFps: 30, convention: 'SMPL' });
  });

  const cells = (change: (cell: string, row: number, column: number) => string): string =>
    writeCsv(joints)
      .trim()
      .split('\n')
      .map((line, row) =>
        line
          .split(',')
          .map((cell, column) => change(cell, row, column))
          .join(','),
      )
      .join('\n');
  test.each([
    [
      'as pandas writes it, with an index',
      cells((cell, row, column) => (column > 0 ? cell : `${row === 0 ? '' : row - 1},${cell}`)),
    ],
    ['with a byte order mark, as Excel writes it', `\uFEFF${writeCsv(joints)}`],
    ['with quotes about everything', cells((cell) => `"${cell}"`)],
    ...['time (ms)', 'time_ms'].map((title): [string, string] => [
      `with ${title}`,
      cells((cell, row, column) => (column > 0 ? cell : row === 0 ? title : String(Number(cell) * 1000))),
    ]),
  ])('CSV %s', async (_, text) => {
    const file = await read({}, ['a.csv', utf8(text)]);
    expect(worstMillimetres(file, joints)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ sourceFps: 30, remarks: [] });
  });

  test('CSV with two dancers', async () => {
    const other = madeMotion({ names: SMPL_NAMES, swing: 25 });
    const tables = [writeCsv(joints, ',', 'leader_'), writeCsv(other, ',', 'follower_')];
    const [first, second] = tables.map((table) => table.trim().split('\n')) as [string[], string[]];
    const text = first.map((line, row) => `${line},${second[row]!.replace(/^[^,]*,/, '')}`).join('\n');
    for (const [part, motion] of [joints, other].entries()) {
      const file = await read({ part }, ['a.csv', utf8(text)]);
      expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
      expect(file.report).toMatchObject({ parts: ['leader', 'follower'], part });
    }
  });

  test('JSON whose joints have names that say nothing, and parents', async () => {
    const dance = madeMotion();
    const data = positionsOf(
      dance,
      dance.joints.map(({ name }) => name),
    );
    const count = dance.joints.length;
    const json = {
      fps: 30,
      joints: dance.joints.map((_, joint) => `j${joint}`),
      parents: dance.joints.map(({ parent }) => parent),
      positions: Array.from({ length: dance.frames }, (_, frame) =>
        dance.joints.map((_joint, joint) => readVec(data, frame * count + joint)),
      ),
    };
    const file = await read({}, ['a.json', utf8(JSON.stringify(json))]);
    expect(file.report).toMatchObject({ mappedBy: 'structure', unit: 'metres', sourceFps: 30 });
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
  });

  test('CSV that lacks an axis of a joint is refused, and the joint named', async () => {
    const text = writeCsv(joints).replace('left_wrist_z', 'left_wrist_depth');
    await expect(read({}, ['a.csv', utf8(text)])).rejects.toMatchObject({
      code: 'missing-joints',
      message: expect.stringContaining('no joint was found for left wrist.') as string,
    });
  });

  test('CSV with decimal commas in quotes is refused', async () => {
    const text = cells((cell, row) => (row === 0 ? cell : `"${cell.replace('.', ',')}"`));
    await expect(read({}, ['a.csv', utf8(text)])).rejects.toMatchObject({ code: 'bad-number' });
  });

  test('CSV that states its frame rate in a comment', async () => {
    const fast = madeMotion({ names: SMPL_NAMES, fps: 60, frames: 81 });
    const [titles, ...rows] = writeCsv(fast).split('\n');
    const text = ['# fps: 60', titles!.replace('time', 'frame'), ...rows].join('\n');
    const file = await read({}, ['a.csv', utf8(text)]);
    expect(worstMillimetres(file, fast, 2)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ sourceFps: 60, remarks: [] });
  });

  test('feet that a table lacks point where the dancer turns', async () => {
    const places = joints.places.map((row, frame) =>
      row.map((place) => rotate(aboutAxis(Y_AXIS, (2 * Math.PI * frame) / joints.frames), place)),
    );
    const turning = { ...joints, places };
    const rows = writeCsv(turning)
      .trim()
      .split('\n')
      .map((row) => row.split(','));
    const kept = [...rows[0]!.keys()].filter((column) => !/_foot_/.test(rows[0]![column]!));
    const text = rows.map((row) => kept.map((column) => row[column]).join(',')).join('\n');
    const { clip, report } = await read({}, ['a.csv', utf8(text)]);
    expect(report.estimated).toEqual(['left_foot', 'right_foot']);
    for (let frame = 0; frame < clip.frames; frame++) {
      const at = (joint: number): Vec3 => readVec(clip.positions, frame * JOINT_COUNT + joint);
      const left = sub(at(J.left_hip), at(J.right_hip));
      const foot = sub(at(J.left_foot), at(J.left_ankle));
      const ahead = direction(cross([left[0], 0, left[2]], Y_AXIS), ZERO);
      expect(dot(ahead, direction([foot[0], 0, foot[2]], ZERO))).toBeGreaterThan(0.99);
    }
  });

  test('a wrong map shows as millimetres', async () => {
    const swapped = SMPL22.map((name) => name.replace(/^(left|right)_(elbow|wrist)$/, '$1_shoulder'));
    const data = positionsOf(joints, swapped);
    const file = await read({}, ['a.npz', writeArchive({ leader: { shape: [40, 22, 3], data } })]);
    expect(worstMillimetres(file, joints)).toBeGreaterThan(200);
  });
});

describe('FBX', () => {
  const dance = madeMotion();
  test.each([
    ['centimetres, y up', 'centimetres', {}],
    ['metres, z up', 'metres', { unitsPerMetre: 1, up: 'z' as const }],
    ['inches, with pre-rotations', 'inches', { unitsPerMetre: 1 / 0.0254, preRotation: true }],
    ['z up, with pre-rotations', 'centimetres', { up: 'z' as const, preRotation: true }],
    ['keys that begin after two seconds', 'centimetres', { begin: 2 }],
    ['version 7.5', 'centimetres', { wide: true }],
    ['an armature below scaled objects', 'centimetres', { armature: true, preRotation: true }],
    ['a mesh, attributes and curves of other properties', 'centimetres', { others: true }],
    [
      'numbers of objects that a double does not hold',
      'centimetres',
      { firstId: 9_223_372_036_800_000_000n },
    ],
  ])('%s', async (_, unit, options) => {
    for (const bytes of [writeFbxBinary(dance, options), writeFbxAscii(dance, options)]) {
      const file = await read({}, ['a.fbx', bytes]);
      expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
      const expected = { format: 'FBX', convention: 'Mixamo', unit, sourceFps: 30, warnings: [] };
      expect(file.report).toMatchObject(expected);
    }
  });

  test('one of several clips, at 60 frames per second', async () => {
    const fast = madeMotion({ fps: 60, frames: 81 });
    const bytes = writeFbxBinary(fast, { clips: ['dance', 'still'] }, false);
    const file = await read({}, ['a.fbx', bytes]);
    expect(worstMillimetres(file, fast, 2)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ parts: ['dance', 'still'], part: 0, sourceFps: 60 });
    expect((await read({ part: 1 }, ['a.fbx', bytes])).report.part).toBe(1);
  });

  test('every clip is read with the dancer that it moves', async () => {
    const other = madeMotion({ swing: 30 });
    const bytes = writeFbxDuet([dance, other], ['leader', 'follower']);
    for (const [part, motion] of [dance, other].entries()) {
      const file = await read({ part }, ['a.fbx', bytes]);
      expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
      expect(file.report).toMatchObject({ parts: ['leader', 'follower'], part });
    }
  });

  test('a pose of one key before the dance is not among the clips', async () => {
    const options = { pose: 'T-pose', clips: ['dance', 'still'] };
    const file = await read({}, ['a.fbx', writeFbxBinary(dance, options)]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ parts: ['dance', 'still'], part: 0 });
    const pose = read({}, ['a.fbx', writeFbxBinary(dance, { pose: 'T-pose', clips: [] })]);
    await expect(pose).rejects.toMatchObject({ code: 'too-few-frames' });
  });

  test('a clip that moves nothing is no animation', async () => {
    const files = [writeFbxBinary, writeFbxAscii].map((write) => write(dance, { clips: [], others: true }));
    for (const bytes of files) {
      const reading = read({}, ['a.fbx', bytes]);
      await expect(reading).rejects.toMatchObject({ code: 'no-motion' });
    }
  });

  test.each([30, 60, 30000 / 1001, 60000 / 1001, 24000 / 1001])(
    'a dancer who turns all the time, keyed at %d frames per second',
    async (fps) => {
      const still = madeMotion({ fps, frames: Math.round(20 * fps) });
      const rotations = still.rotations.map((turns, frame) =>
        turns.map((turn, joint) => (joint === 0 ? aboutAxis(Y_AXIS, (Math.PI * frame) / fps) : turn)),
      );
      const file = await read({}, ['a.fbx', writeFbxBinary({ ...still, rotations })]);
      const { positions, frames } = file.clip;
      const heading = (frame: number): number => {
        const [left, right] = (['left_hip', 'right_hip'] as const).map((name) =>
          readVec(positions, frame * JOINT_COUNT + J[name]),
        ) as [Vec3, Vec3];
        return Math.atan2(left[2] - right[2], left[0] - right[0]);
      };
      const steps = Array.from({ length: frames - 1 }, (_, frame) => {
        const step = heading(frame + 1) - heading(frame);
        return (Math.abs(Math.atan2(Math.sin(step), Math.cos(step))) * 180) / Math.PI;
      });
      expect(Math.max(...steps)).toBeLessThan(6.1);
      expect(file.report.sourceFps).toBeCloseTo(fps, 6);
      // As long as from the first key to the last one.
      expect(frames).toBe(Math.floor(((still.frames - 1) / fps) * 30 + 1e-6) + 1);
    },
  );

  test('a frame rate is that of the keys where a few of them are left out', async () => {
    const text = new TextDecoder().decode(writeFbxAscii(madeMotion({ frames: 100 })));
    // The eighth key of every curve.
    const fewer = text.replaceAll(
      /\*100 \{\n(\s*a: (?:[^,\n]+,){7})[^,\n]+,/g,
      (_, kept: string) => `*99 {\n${kept}`,
    );
    expect(fewer).not.toBe(text);
    expect((await read({}, ['a.fbx', utf8(fewer)])).report.sourceFps).toBe(30);
  });

  test('a unit that makes a dwarf is doubted', async () => {
    const file = await read({ unit: 'millimetres' }, ['a.fbx', writeFbxBinary(dance)]);
    expect(file.report.warnings.join()).toContain('smaller than people are');
  });

  test.each([
    ['24', { timeMode: 11 }, 24],
    ['48, as a rate of its own', { timeMode: 14, customRate: 48 }, 48],
    ['none', { timeMode: 0 }, 30],
  ])('keys that are far apart are read at the frame rate of the settings: %s', async (_, options, fps) => {
    const sparse = madeMotion({ fps: 2, frames: 9 });
    const { clip, report } = await read({}, ['a.fbx', writeFbxBinary(sparse, options)]);
    expect(report.sourceFps).toBe(fps);
    expect(clip.frames).toBe(4 * 30 + 1);
  });

  test('objects that are no joints are read as such where a file has nothing else', async () => {
    const text = new TextDecoder().decode(writeFbxAscii(dance)).replaceAll('"LimbNode"', '"Null"');
    expect(worstMillimetres(await read({}, ['a.fbx', utf8(text)]), dance)).toBeLessThan(WORST);
  });

  test('a text that lacks its end is named', () => {
    const text = new TextDecoder().decode(writeFbxAscii(dance));
    expect(() => readFbx(utf8(text.slice(0, text.lastIndexOf('}'))), 0)).toThrow(/it ends too early/);
  });

  test('the up axis of the settings has a sign', () => {
    const text = new TextDecoder().decode(writeFbxAscii(dance));
    const down = text.replace(/("UpAxisSign".*, )1$/m, '$1-1');
    expect(readFbx(utf8(text), 0).upAxis).toBe('y');
    expect(readFbx(utf8(down), 0).upAxis).toBe('-y');
  });

  test.each([
    ['with z up', { up: 'z' as const }],
    ['whose joints turn about y first', { rotationOrder: 2 }],
    ['whose joints turn about z first', { rotationOrder: 4 }],
    ['with post-rotations', { postRotation: [20, -35, 50] as const }],
  ])('three reads the same from the same file %s', (_, different) => {
    const options = { preRotation: true, ...different };
    const bytes = writeFbxBinary(dance, options);
    const group = new FBXLoader().parse(bytes.buffer, '');
    const mixer = new AnimationMixer(group);
    mixer.clipAction(group.animations[0]!).play();
    for (const frame of [0, 17, 33]) {
      mixer.setTime(frame / 30);
      group.updateMatrixWorld(true);
      const source = readFbx(bytes, 0);
      const { places } = worldPose(source.joints, source.localPoses([frame]), 0);
      source.joints.forEach(({ name }, joint) => {
        const bone = group.getObjectByName(name.replaceAll(/[:.]/g, ''))!;
        // The loader turns the whole group where z is up.
        const place = bone.getWorldPosition(new Vector3()).applyMatrix4(group.matrixWorld.clone().invert());
        expect(distance([place.x, place.y, place.z], places[joint]!)).toBeLessThan(0.01);
      });
    }
  });
});

/** Bones of a VRM humanoid by the names of the plain made body. */
const VRM_BONES = new Map([
  ['mixamorig:Hips', 'hips'],
  ['mixamorig:Spine', 'spine'],
  ['mixamorig:Spine1', 'chest'],
  ['mixamorig:Spine2', 'upperChest'],
  ['mixamorig:Neck', 'neck'],
  ['mixamorig:Head', 'head'],
  ...['Left', 'Right'].flatMap((side): [string, string][] =>
    [
      ['UpLeg', 'UpperLeg'],
      ['Leg', 'LowerLeg'],
      ['Foot', 'Foot'],
      ['ToeBase', 'Toes'],
      ['Shoulder', 'Shoulder'],
      ['Arm', 'UpperArm'],
      ['ForeArm', 'LowerArm'],
      ['Hand', 'Hand'],
    ].map(([from, to]) => [`mixamorig:${side}${from!}`, `${side.toLowerCase()}${to!}`]),
  ),
]);

describe('glTF and VRM', () => {
  const dance = madeMotion();
  const turned = aboutAxis([0.6, 0, 0.8], 1.1);

  test.each([
    ['plain', {}],
    ['cubic splines', { interpolation: 'CUBICSPLINE' as const }],
    ['steps', { interpolation: 'STEP' as const }],
    ['turned rest pose', { restTurn: turned }],
    ['a scaled armature with z up above the root', { armature: true }],
    ['an armature that is scaled by keys', { armature: true, scaleKeys: true }],
    ['keys that begin after two seconds', { begin: 2 }],
    ['interleaved values', { gap: 8 }],
  ])('GLB, %s', async (_, options) => {
    const file = await read({}, ['a.glb', writeGlb(dance, options)]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ format: 'glTF', convention: 'Mixamo', sourceFps: 30, warnings: [] });
    expect(file.report).toMatchObject({ unit: 'metres', upAxis: 'y' });
  });

  test('at 60 frames per second', async () => {
    const fast = madeMotion({ fps: 60, frames: 81 });
    const file = await read({}, ['a.glb', writeGlb(fast)]);
    expect(file.report.sourceFps).toBe(60);
    expect(file.clip.frames).toBe(41);
    expect(worstMillimetres(file, fast, 2)).toBeLessThan(WORST);
  });

  test('rotations as normalised whole numbers', async () => {
    const file = await read({}, ['a.glb', writeGlb(dance, { shorts: true })]);
    expect(worstMillimetres(file, dance)).toBeLessThan(0.5);
  });

  test('a matrix in place of translation, rotation and scale', async () => {
    const bytes = changedGlb(writeGlb(dance, { armature: true }), ({ nodes }) => {
      // Turned by a quarter from z up to y up, in columns.
      const matrix = [0.01, 0, 0, 0, 0, 0, -0.01, 0, 0, 0.01, 0, 0, 0, 0, 0, 1];
      nodes[dance.joints.length] = { name: 'Armature', matrix, children: [0] };
    });
    const file = await read({}, ['a.glb', bytes]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ unit: 'metres', upAxis: 'y' });
  });

  test('steps hold every key until the next one', async () => {
    const slow = madeMotion({ fps: 15, frames: 20 });
    const { clip, report } = await read({}, ['a.glb', writeGlb(slow, { interpolation: 'STEP' })]);
    expect(report.sourceFps).toBe(30);
    expect(clip.frames).toBe(39);
    const frame = (at: number): Float32Array =>
      clip.positions.subarray(at * JOINT_COUNT * 3, (at + 1) * JOINT_COUNT * 3);
    expect(frame(11)).toEqual(frame(10));
    expect(frame(12)).not.toEqual(frame(11));
  });

  test('the unit that glTF states is not taken where the body would be a giant', async () => {
    const file = await read({}, ['a.glb', writeGlb(dance, { grown: 100 })]);
    expect(file.report.unit).toBe('centimetres');
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
  });

  test('where a lying body leaves it open, up is what glTF states', async () => {
    const still = madeMotion({ swing: 0 });
    const lean = aboutAxis(X_AXIS, 0.9);
    const rotations = still.rotations.map((turns) =>
      turns.map((turn, joint) => (joint === 0 ? multiply(lean, turn) : turn)),
    );
    const { report } = await read({}, ['a.glb', writeGlb({ ...still, rotations })]);
    expect(report).toMatchObject({ upAxis: 'y', warnings: [] });
  });

  test('glTF with its numbers inside, and in a file beside it', async () => {
    const inside = await read({}, ['a.gltf', writeGltf(dance, null).gltf]);
    expect(worstMillimetres(inside, dance)).toBeLessThan(WORST);
    const { gltf, bin } = writeGltf(dance, 'numbers.bin');
    const beside = await read({}, ['a.gltf', gltf], ['numbers.bin', bin]);
    expect(worstMillimetres(beside, dance)).toBeLessThan(WORST);
    const renamed = await read({}, ['a.gltf', gltf], ['renamed.bin', bin]);
    expect(worstMillimetres(renamed, dance)).toBeLessThan(WORST);
    await expect(read({}, ['a.gltf', gltf])).rejects.toMatchObject({ code: 'missing-file' });
    await expect(read({}, ['a.gltf', gltf], ['numbers.bin', bin.subarray(0, 99)])).rejects.toMatchObject({
      code: 'unreadable-file',
      message: expect.stringMatching(/numbers\.bin has 99 of its \d+ bytes/) as string,
    });
    // As programs write addresses, and macOS names of files.
    const encoded = writeGltf(dance, 'T%C3%A4nzer%281%29.bin');
    const there: [string, Uint8Array] = ['Ta\u0308nzer(1).bin', encoded.bin];
    const found = await read({}, ['a.gltf', encoded.gltf], ['other.bin', new Uint8Array(4)], there);
    expect(worstMillimetres(found, dance)).toBeLessThan(WORST);
  });

  test('one of several clips, which is said until one is chosen', async () => {
    const bytes = writeGlb(dance, { clips: ['dance', 'still'] });
    const first = await read({}, ['a.glb', bytes]);
    expect(worstMillimetres(first, dance)).toBeLessThan(WORST);
    expect(first.report.remarks.join()).toContain('2 motions; “dance” was read');
    const still = await read({ part: 1 }, ['a.glb', bytes]);
    expect(still.report).toMatchObject({ parts: ['dance', 'still'], part: 1, remarks: [] });
    expect(worstMillimetres(still, dance)).toBeGreaterThan(50);
  });

  const other = madeMotion({ swing: 30 });
  const duet = joinedGlb(
    writeGlb(dance, { clips: ['leader'], armature: true }),
    writeGlb(other, { clips: ['follower'], armature: true }),
  );

  test('every clip is read with the dancer that it moves', async () => {
    for (const [part, motion] of [dance, other].entries()) {
      const file = await read({ part }, ['a.glb', duet]);
      expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
      expect(file.report).toMatchObject({ parts: ['leader', 'follower'], part });
    }
  });

  test('the dancers of one clip, in the order of the file', async () => {
    const bytes = changedGlb(duet, (json) => {
      [dance, other].forEach(
        ({ joints }, i) => (json.nodes[(i + 1) * joints.length + i]!.name = `dancer ${i}`),
      );
      joinClips(json);
    });
    for (const [part, motion] of [dance, other].entries()) {
      const file = await read({ part }, ['a.glb', bytes]);
      expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
      expect(file.report).toMatchObject({ parts: ['dancer 0', 'dancer 1'], part });
    }
  });

  test('of several clips that each move two dancers the first dancer is read, and the report names the other', async () => {
    const bytes = changedGlb(duet, ({ nodes, animations }) => {
      [dance, other].forEach(({ joints }, i) => (nodes[(i + 1) * joints.length + i]!.name = `dancer ${i}`));
      const [first, second] = animations as [(typeof animations)[0], (typeof animations)[0]];
      const count = first.samplers.length;
      first.channels.push(
        ...second.channels.map(({ sampler, target }) => ({ sampler: sampler + count, target })),
      );
      first.samplers.push(...second.samplers);
    });
    const both = await read({}, ['a.glb', bytes]);
    expect(worstMillimetres(both, dance)).toBeLessThan(WORST);
    expect(both.report.parts).toEqual(['leader', 'follower']);
    expect(both.report.warnings.join()).toMatch(
      /“leader” moves 2 dancers; “dancer 0” was read, not “dancer 1”/,
    );
    expect((await read({ part: 1 }, ['a.glb', bytes])).report.warnings.join()).not.toContain('dancers');
  });

  test('a pose of one key and a clip of shapes alone are not among the clips', async () => {
    const bytes = changedGlb(writeGlb(dance, { clips: ['dance', 'still'] }), ({ animations, accessors }) => {
      const firstKey = (accessor: number): number =>
        accessors.push({ ...accessors[accessor]!, count: 1 }) - 1;
      const { samplers, channels } = animations[0]!;
      const pose = samplers.map((one) => ({ input: firstKey(one.input), output: firstKey(one.output) }));
      const shapes = { sampler: 0, target: { node: 0, path: 'weights' } };
      animations.unshift(
        { name: 'T-pose', samplers: pose, channels },
        { name: 'smile', samplers, channels: [shapes] },
      );
    });
    const file = await read({}, ['a.glb', bytes]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ parts: ['dance', 'still'], part: 0 });
    const pose = changedGlb(bytes, ({ animations }) => animations.splice(2));
    await expect(read({}, ['a.glb', pose])).rejects.toMatchObject({ code: 'too-few-frames' });
  });

  test('a damaged clip beside others is not among the clips', async () => {
    const bytes = changedGlb(writeGlb(dance, { clips: ['dance', 'still'] }), ({ animations }) => {
      const { samplers, channels } = animations[0]!;
      animations.unshift({
        name: 'damaged',
        samplers: samplers.map((one) => ({ ...one, output: 9999 })),
        channels,
      });
    });
    const file = await read({}, ['a.glb', bytes]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ parts: ['dance', 'still'], part: 0 });
    const alone = changedGlb(bytes, ({ animations }) => animations.splice(1));
    await expect(read({}, ['a.glb', alone])).rejects.toMatchObject({ code: 'unreadable-file' });
  });

  test('a mesh with the name of a joint, as Blender writes it before the bones', async () => {
    const named = madeMotion({ names: CONVENTIONS.find(({ label }) => label === 'LaFAN1')!.names });
    const bytes = changedGlb(writeGlb(named, { armature: true }), (json) => {
      json.meshes = [{ primitives: [{ attributes: {} }] }];
      json.skins = [{ joints: [...named.joints.keys()] }];
      const mesh = json.nodes.push({ name: 'Head', mesh: 0, skin: 0 }) - 1;
      json.nodes[mesh - 1]!.children!.unshift(mesh);
    });
    const file = await read({}, ['a.glb', bytes]);
    expect(worstMillimetres(file, named)).toBeLessThan(WORST);
    expect(file.report.warnings).toEqual([]);
  });

  test('a figure of rigid parts, whose joints are meshes', async () => {
    const bytes = changedGlb(writeGlb(dance), ({ nodes }) => nodes.forEach((node) => (node.mesh = 0)));
    expect(worstMillimetres(await read({}, ['a.glb', bytes]), dance)).toBeLessThan(WORST);
  });

  test('VRMA names its bones, whatever the nodes are called', async () => {
    const anonymous = {
      ...dance,
      joints: dance.joints.map((joint, i) => ({ ...joint, name: `node ${i}` })),
    };
    const bones = new Map(
      [...VRM_BONES].map(([name, bone]) => {
        const joint = dance.joints.findIndex((one) => one.name === name);
        return [`node ${joint}`, bone];
      }),
    );
    const humanoid = { extension: 'VRMC_vrm_animation', bones };
    const file = await read({}, ['a.vrma', writeGlb(anonymous, { humanoid, restTurn: turned })]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
    expect(file.report).toMatchObject({ format: 'VRMA', convention: 'VRM / Unity' });
  });

  const vrma = writeGlb(dance, {
    humanoid: { extension: 'VRMC_vrm_animation', bones: VRM_BONES },
    restTurn: turned,
  });

  test('a VRM lends a VRMA its body', async () => {
    const vrm = writeGlb(dance, {
      humanoid: { extension: 'VRMC_vrm', bones: VRM_BONES },
      clips: [],
      grown: 0.8,
    });
    const file = await read({}, ['a.vrma', vrma], ['a.vrm', vrm]);
    const small = madeMotion({
      body: madeBody(MIXAMO).map((joint) => ({
        ...joint,
        offset: joint.offset.map((value) => value * 0.8) as unknown as Vec3,
      })),
    });
    const expected = { ...small, root: dance.root.map((place) => scale(place, 0.8)) };
    const shifted = expected.root.map((place, frame) => sub(place, small.root[frame]!));
    const places = small.places.map((row, frame) => row.map((place) => add(place, shifted[frame]!)));
    expect(file.report.format).toBe('VRMA on a VRM');
    expect(worstMillimetres(file, { ...expected, places })).toBeLessThan(WORST);
    await expect(read({}, ['a.vrm', vrm])).rejects.toMatchObject({ code: 'no-motion' });
  });

  test('a VRM lends a gesture its legs, and to any VRMA its bones alone', async () => {
    const vrm = writeGlb(dance, { humanoid: { extension: 'VRMC_vrm', bones: VRM_BONES }, clips: [] });
    const upper = new Map([...VRM_BONES].filter(([, bone]) => !/Leg|Foot|Toes|Shoulder|neck/.test(bone)));
    const humanoid = { extension: 'VRMC_vrm_animation', bones: upper };
    const gesture = writeGlb(dance, { humanoid, restTurn: turned });
    const file = await read({}, ['a.vrma', gesture], ['a.vrm', vrm]);
    const whole = await read({}, ['a.vrma', vrma], ['a.vrm', vrm]);
    expect(file.report.format).toBe('VRMA on a VRM');
    expect(file.report.estimated).toEqual(whole.report.estimated);
    const arm = ({ clip }: LeaderFile, frame: number): Vec3 => {
      const [pelvis, wrist] = [J.pelvis, J.left_wrist].map((joint) =>
        readVec(clip.positions, frame * JOINT_COUNT + joint),
      );
      return sub(wrist!, pelvis!);
    };
    // The shoulders' own turns alone are missing.
    for (const frame of [0, 17, 33]) expect(distance(arm(file, frame), arm(whole, frame))).toBeLessThan(0.05);

    // Nodes that are no bones but have their names, as those that a face is moved by.
    const named = changedGlb(vrma, ({ nodes, scenes }) => {
      for (const name of ['head', 'hips']) scenes[0]!.nodes.push(nodes.push({ name }) - 1);
    });
    expect(worstMillimetres(await read({}, ['a.vrma', named], ['a.vrm', vrm]), dance)).toBeLessThan(WORST);
  });

  test('a VRM 0, whose body faces backwards, moves as the VRMA', async () => {
    const backwards = {
      ...dance,
      joints: dance.joints.map((joint) => {
        const [x, y, z] = joint.offset;
        return { ...joint, offset: [-x, y, -z] as const };
      }),
    };
    const humanoid = { extension: 'VRM', bones: VRM_BONES };
    const vrm = changedGlb(writeGlb(backwards, { humanoid, clips: [] }), ({ nodes, extensions }) => {
      const humanBones = [...VRM_BONES].map(([name, bone]) => ({
        bone,
        node: nodes.findIndex((one) => one.name === name),
      }));
      extensions!['VRM'] = { specVersion: '0.0', humanoid: { humanBones } };
    });
    const file = await read({}, ['a.vrma', vrma], ['a.vrm', vrm]);
    expect(worstMillimetres(file, dance)).toBeLessThan(WORST);
  });

  test('three reads the same from the same file', async () => {
    const bytes = writeGlb(dance, { interpolation: 'CUBICSPLINE', armature: true, restTurn: turned });
    const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer, '');
    const mixer = new AnimationMixer(scene);
    mixer.clipAction(animations[0]!).play();
    const source = readGltf([{ name: 'a.glb', bytes }], 0);
    for (const frame of [0, 17, 33]) {
      mixer.setTime(frame / 30);
      scene.updateMatrixWorld(true);
      const { places } = worldPose(source.joints, source.localPoses([frame]), 0);
      source.joints.forEach(({ name }, joint) => {
        const bone = scene.getObjectByName(name.replaceAll(/[:.]/g, ''))!;
        const { x, y, z } = bone.getWorldPosition(new Vector3());
        expect(distance([x, y, z], places[joint]!)).toBeLessThan(1e-5);
      });
    }
  });
});
