import { describe, expect, test } from 'vitest';
import { AVERAGE_BODY } from '../../../../web/motion/import/average-body';
import { groupCompanions } from '../../../../web/motion/import/format';
import { readLeaderFile } from '../../../../web/motion/import/read';
import { MMD_JOINTS, mmdBone } from '../../../../web/motion/import/vmd/body';
import { poseAt } from '../../../../web/motion/import/vmd/curve';
import { readVmdFile } from '../../../../web/motion/import/vmd/file';
import { readVmd } from '../../../../web/motion/import/vmd/read';
import { aboutAxis, multiply, type Quat } from '../../../../web/motion/math/quat';
import {
  add,
  direction,
  distance,
  lerp,
  readVec,
  sub,
  type Vec3,
  X_AXIS,
  Z_AXIS,
} from '../../../../web/motion/math/vec3';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import type { ImportOptions } from '../../../../web/motion/retarget/options';
import { worldPose } from '../../../../web/motion/retarget/sample';
import { J, JOINT_COUNT, PARENTS, SMPL22 } from '../../../../web/motion/skeleton/skeleton';
import { ASF_NAMES, writeAmc } from '../../support/motion-files/amc';
import { SMPL_NAMES, writeArchive } from '../../support/motion-files/arrays';
import { writeC3d } from '../../support/motion-files/c3d';
import { inFile, madeMotion, worstMillimetres } from '../../support/motion-files/made-motion';
import { type MadeKey, writeVmd } from '../../support/motion-files/vmd';

const read = (options: ImportOptions, ...files: [string, Uint8Array][]): Promise<LeaderFile> =>
  readLeaderFile(
    files.map(([name, bytes]) => ({ name, bytes })),
    options,
  );

describe('AMC with ASF', () => {
  const dance = madeMotion({ names: ASF_NAMES, fps: 120, frames: 81 });
  const { amc, asf } = writeAmc(dance);

  test('both together, in any order', async () => {
    for (const files of [
      [['a.amc', amc] as const, ['a.asf', asf] as const],
      [['a.asf', asf] as const, ['a.amc', amc] as const],
    ] as const) {
      const file = await read({}, ...files.map(([name, bytes]): [string, Uint8Array] => [name, bytes]));
      expect(worstMillimetres(file, dance, 4)).toBeLessThan(0.1);
      expect(file.report).toMatchObject({
        convention: 'CMU (ASF)',
        unit: 'CMU units of 5.64 cm',
        sourceFps: 120,
      });
    }
  });

  test.each([
    ['radians', { inRadians: true }],
    ['bones that turn about z first', { zFirst: true }],
    ['a hierarchy from the tips to the root', { tipsFirst: true }],
  ])('%s', async (_, options) => {
    const written = writeAmc(dance, options);
    const file = await read({}, ['a.amc', written.amc], ['a.asf', written.asf]);
    expect(worstMillimetres(file, dance, 4)).toBeLessThan(0.1);
  });

  const changed = (bytes: Uint8Array, change: (text: string) => string): Uint8Array =>
    new TextEncoder().encode(change(new TextDecoder().decode(bytes)));

  test.each([
    ['within a number', (text: string) => text.slice(0, text.lastIndexOf(' ') + 1)],
    [
      'within the name of a bone',
      (text: string) => text.slice(0, text.lastIndexOf('\n', text.length - 2) + 3),
    ],
    ['between two bones', (text: string) => text.slice(0, text.lastIndexOf('\n', text.length - 2) + 1)],
  ])('a motion that is cut off %s of its last frame has the whole frames, and says so', async (_, cut) => {
    const file = await read({}, ['a.amc', changed(amc, cut)], ['a.asf', asf]);
    expect(file.report.warnings).toEqual([
      'The file ends in the middle of frame 81; the 80 whole frames are used.',
    ]);
    expect(file.clip.frames).toBe(20);
    expect(worstMillimetres(file, dance, 4)).toBeLessThan(0.1);
  });

  test.each(['\r\n', '\r'])('lines that end in %j', async (newline) => {
    const [motion, skeleton] = [amc, asf].map((bytes) =>
      changed(bytes, (text) => text.replaceAll('\n', newline)),
    ) as [Uint8Array, Uint8Array];
    const file = await read({}, ['a.amc', motion], ['a.asf', skeleton]);
    expect(worstMillimetres(file, dance, 4)).toBeLessThan(0.1);
  });

  test('the skeleton of another person, who has other bones', async () => {
    const other = new TextDecoder().decode(amc).replaceAll('lfemur', 'lthigh');
    const motion = new TextEncoder().encode(other);
    await expect(read({}, ['a.amc', motion], ['a.asf', asf])).rejects.toMatchObject({
      code: 'missing-joints',
      message: 'The motion moves a bone "lthigh" that the skeleton does not have.',
    });
  });

  test('each motion of a duet has the skeleton of its own dancer', () => {
    const files = ['60_10.amc', '6.asf', '60.asf', '61_10.amc', '61.asf', '6-1.amc', 'a.amc', 'a.asf'];
    const groups = groupCompanions(files.map((name) => ({ name })));
    expect(groups.map((group) => group.map(({ name }) => name))).toEqual([
      ['60_10.amc', '60.asf'],
      ['61_10.amc', '61.asf'],
      ['6-1.amc', '6.asf'],
      ['a.amc', 'a.asf'],
    ]);
    const [only] = groupCompanions([{ name: 'dance.amc' }, { name: 'skeleton.asf' }]);
    expect(only).toHaveLength(2);
    // A glTF may need all of them.
    const buffers = ['dance-2.gltf', 'dance.bin', 'data.bin'].map((name) => ({ name }));
    expect(groupCompanions(buffers)).toEqual([buffers]);
    const two = ['dance.gltf', 'dance.bin', 'data.bin', 'other.gltf', 'other.bin'].map((name) => ({ name }));
    expect(groupCompanions(two).map((group) => group.map(({ name }) => name))).toEqual([
      ['dance.gltf', 'dance.bin', 'data.bin'],
      ['other.gltf', 'data.bin', 'other.bin'],
    ]);
  });

  test('one without the other is asked for', async () => {
    await expect(read({}, ['a.amc', amc])).rejects.toMatchObject({ code: 'missing-file' });
    await expect(read({}, ['a.asf', asf])).rejects.toMatchObject({ code: 'missing-file' });
  });
});

describe('C3D', () => {
  const dance = madeMotion({ swing: 8 });
  /** Markers lie on the skin; centres of joints are estimated from them, and collars have no marker. */
  const withoutCollars = (motion: typeof dance): typeof dance => {
    const names = Object.entries(motion.names).filter(([part]) => part !== 'collar');
    return { ...motion, names: Object.fromEntries(names) as unknown as typeof dance.names };
  };

  test.each([
    ['floats', {}],
    ['whole numbers and a name of the dancer', { integers: true, subject: 'Ana:' }],
    [
      'markers that are hidden for a while',
      { hidden: (label: string, frame: number) => label === 'LKNE' && frame % 9 === 4 },
    ],
    ['numbers of a DEC processor', { processor: 'dec' as const }],
    ['numbers of a MIPS processor', { processor: 'mips' as const }],
    ['whole numbers of a MIPS processor', { processor: 'mips' as const, integers: true }],
    ['force plates, and a beginning that is cut off', { analog: 12, first: 240 }],
    ['labels in two lists, and the frame rate in its head', { listed: 9, rateInHead: true }],
  ])('%s', async (_, options) => {
    const file = await read({}, ['a.c3d', writeC3d(dance, options)]);
    expect(file.report).toMatchObject({
      format: 'C3D',
      convention: 'Plug-in Gait',
      upAxis: 'z',
      unit: 'mm',
      sourceFps: 30,
    });
    expect(worstMillimetres(file, withoutCollars(dance))).toBeLessThan(25);
    expect(file.report.estimated).not.toContain('left_foot');
  });

  test('metres', async () => {
    const file = await read({}, ['a.c3d', writeC3d(dance, { unit: 'm' })]);
    expect(file.report.unit).toBe('m');
    expect(worstMillimetres(file, withoutCollars(dance))).toBeLessThan(25);
  });

  test('a marker that is hidden for a while moves straight on', async () => {
    const hidden = (label: string, frame: number): boolean => label === 'LTOE' && frame >= 10 && frame < 20;
    const [seen, file] = [
      await read({}, ['a.c3d', writeC3d(dance)]),
      await read({}, ['a.c3d', writeC3d(dance, { hidden })]),
    ];
    const toe = ({ clip }: LeaderFile, frame: number): Vec3 =>
      readVec(clip.positions, frame * JOINT_COUNT + J.left_foot);
    const [before, after] = [toe(seen, 9), toe(seen, 20)];
    for (const frame of [9, 12, 15, 18, 20])
      expect(distance(toe(file, frame), lerp(before, after, (frame - 9) / 11))).toBeLessThan(1e-4);
  });

  test('one of two dancers, under the names that the file has for them', async () => {
    const other = madeMotion({ swing: 20 });
    const beside = { subject: 'Ben:', motion: other };
    const bytes = writeC3d(dance, { subject: 'Ana:', beside });
    for (const [part, motion] of [dance, other].entries()) {
      const file = await read({ part }, ['a.c3d', bytes]);
      expect(file.report).toMatchObject({ parts: ['Ana', 'Ben'], part });
      expect(worstMillimetres(file, withoutCollars(motion))).toBeLessThan(40);
    }
  });

  test('one marker behind the pelvis, and one on each hand', async () => {
    const relabel = (label: string): string | null =>
      label === 'LPSI' ? 'SACR' : /RPSI|WRB/.test(label) ? null : label.replace('WRA', 'FIN');
    const file = await read({}, ['a.c3d', writeC3d(dance, { relabel })]);
    expect(worstMillimetres(file, withoutCollars(dance))).toBeLessThan(60);
  });

  test('a marker that lacks is named', async () => {
    const bytes = writeC3d(dance, { hidden: (label) => label === 'RANK' });
    await expect(read({}, ['a.c3d', bytes])).rejects.toThrow(/lacks markers of Plug-in Gait: RANK\./);
  });
});

describe('AMASS', () => {
  const hips: Vec3 = [0, 0.95, 0];
  const body = SMPL22.map((name, joint) => ({
    name,
    parent: joint === 0 ? null : SMPL22[PARENTS[joint]!]!,
    offset: joint === 0 ? hips : AVERAGE_BODY[name],
  }));
  const dance = madeMotion({ names: SMPL_NAMES, body, fps: 60, frames: 61 });
  const index = new Map(dance.joints.map(({ name }, joint) => [name, joint]));

  /** Names of the arrays of rotations, of the root's place and of the frame rate. */
  type ArchiveNames = readonly [string, string, string];

  /** The motion as rotation vectors, with z up. */
  function archive(width: number, names: ArchiveNames = ['poses', 'trans', 'mocap_framerate']): Uint8Array {
    const [turns, place, rate] = names;
    const upright = aboutAxis(X_AXIS, Math.PI / 2);
    const rotation = (turns: readonly Quat[], joint: number): Vec3 => {
      const own = turns[index.get(SMPL22[joint]!)!]!;
      const [x, y, z, w] = joint === 0 ? multiply(upright, own) : own;
      const sine = Math.hypot(x, y, z);
      const factor = sine > 1e-9 ? (2 * Math.atan2(sine, w)) / sine : 0;
      return [x * factor, y * factor, z * factor];
    };
    const poses = dance.rotations.flatMap((turns) => [
      ...SMPL22.flatMap((_, joint) => rotation(turns, joint)),
      ...new Array<number>(width - 66).fill(0.1),
    ]);
    return writeArchive({
      [turns]: { shape: [61, width], data: Float64Array.from(poses) },
      [place]: {
        shape: [61, 3],
        data: Float64Array.from(dance.root.flatMap((place) => inFile(place, 1, 'z'))),
      },
      [rate]: { shape: [], data: Float64Array.of(60) },
      gender: { shape: [], data: ['neutral'] },
    });
  }

  test.each([
    ['smpl_poses', 'smpl_trans', 'fps'],
    ['fullpose', 'transl', 'mocap_frame_rate'],
    ['full_pose', 'transl', 'frame_rate'],
    ['full_pose', 'transl', 'framerate'],
  ] as const)('arrays named %s, %s and %s', async (...names) => {
    const file = await read({}, ['a.npz', archive(165, names)]);
    expect(worstMillimetres(file, dance, 2)).toBeLessThan(0.1);
    expect(file.report).toMatchObject({ sourceFps: 60, remarks: [] });
  });

  test.each([72, 156, 165])('poses of %i values', async (width) => {
    const file = await read({}, ['a.npz', archive(width)]);
    expect(worstMillimetres(file, dance, 2)).toBeLessThan(0.1);
    expect(file.report).toMatchObject({ upAxis: 'z', sourceFps: 60, unit: 'metres' });
  });
});

describe('VMD', () => {
  const bend = (bone: string, axis: Vec3, angle: number, frame = 0): MadeKey => ({
    bone,
    frame,
    turn: aboutAxis(axis, angle),
  });
  const still: MadeKey[] = [{ bone: 'センター', frame: 30 }];
  const placesOf = (
    keys: readonly MadeKey[],
    frame: number,
    switches: Parameters<typeof writeVmd>[1] = [],
  ) => {
    const source = readVmd(writeVmd(keys, switches));
    return worldPose(source.joints, source.localPoses([frame]), 0).places;
  };
  const rest = placesOf(still, 0);

  test('arms turn with their bones, twists included', () => {
    const along = direction(sub(rest[mmdBone('左ひじ')]!, rest[mmdBone('左腕')]!), X_AXIS);
    const keys = [
      ...still,
      bend('左腕', Z_AXIS, 0.6),
      bend('左ひじ', Z_AXIS, 0.5),
      bend('左腕捩', along, 0.7),
    ];
    const places = placesOf(keys, 0);
    const [shoulder, elbow] = ['左腕', '左ひじ'].map((name) => places[mmdBone(name)]!) as [Vec3, Vec3];
    const upper = Math.atan2(elbow[1] - shoulder[1], elbow[0] - shoulder[0]);
    expect(upper).toBeCloseTo(-Math.atan2(1.786, 2.285) + 0.6, 4);
    // The twist turns the forearm out of the plane.
    expect(places[mmdBone('左手首')]![2]).toBeGreaterThan(0.3);
    expect(distance(places[mmdBone('左手首')]!, elbow)).toBeCloseTo(2.7, 1);
  });

  test('feet are where their IK bones are, with bent knees', () => {
    const move: Vec3 = [0.5, 1.2, 1.5];
    const keys: MadeKey[] = [
      ...still,
      { bone: '左足ＩＫ', frame: 0, move },
      { bone: 'センター', frame: 0, move: [0, -1, 0] },
    ];
    const places = placesOf(keys, 0);
    expect(distance(places[mmdBone('左足首')]!, add(rest[mmdBone('左足首')]!, move))).toBeLessThan(1e-3);
    const [hip, knee, ankle] = ['左足', '左ひざ', '左足首'].map((name) => places[mmdBone(name)]!) as [
      Vec3,
      Vec3,
      Vec3,
    ];
    const middle = (hip[2] + ankle[2]) / 2;
    expect(knee[2]).toBeGreaterThan(middle + 0.5);
    expect(distance(hip, knee)).toBeCloseTo(distance(rest[mmdBone('左足')]!, rest[mmdBone('左ひざ')]!), 3);
    // Without IK keys the other leg hangs on the body.
    expect(places[mmdBone('右足首')]![1]).toBeCloseTo(rest[mmdBone('右足首')]![1] - 1, 4);
  });

  test('feet stay where their IK bones are while the lower body turns', () => {
    const keys: MadeKey[] = [
      ...still,
      { bone: '左足ＩＫ', frame: 0 },
      { bone: '右足ＩＫ', frame: 0 },
      bend('下半身', Z_AXIS, -0.25),
      bend('左足', X_AXIS, -0.2),
    ];
    const places = placesOf(keys, 0);
    expect(distance(places[mmdBone('左足')]!, rest[mmdBone('左足')]!)).toBeGreaterThan(0.2);
    for (const name of ['左足首', '左つま先'])
      expect(distance(places[mmdBone(name)]!, rest[mmdBone(name)]!)).toBeLessThan(0.05);
  });

  test('a switch turns the placing off', () => {
    const keys: MadeKey[] = [
      ...still,
      { bone: '左足ＩＫ', frame: 0, move: [0, 3, 0] },
      bend('左足', X_AXIS, -0.4),
    ];
    const switched = placesOf(keys, 20, [
      { frame: 0, bone: '左足ＩＫ', on: true },
      { frame: 10, bone: '左足ＩＫ', on: false },
    ]);
    const hip = switched[mmdBone('左足')]!;
    expect(
      Math.atan2(switched[mmdBone('左ひざ')]![2] - hip[2], hip[1] - switched[mmdBone('左ひざ')]![1]),
    ).toBeCloseTo(0.4, 1);
  });

  test('curves between keys are those of the file', () => {
    const keys: MadeKey[] = [
      { bone: 'センター', frame: 0 },
      {
        bone: 'センター',
        frame: 1000,
        move: [10, 10, 10],
        turn: aboutAxis(X_AXIS, 1),
        curve: [100, 10, 120, 30],
      },
    ];
    const { bones } = readVmdFile(writeVmd(keys));
    const t = 0.4;
    const curve = (a: number, b: number): number =>
      (3 * (1 - t) ** 2 * t * a + 3 * (1 - t) * t ** 2 * b) / 127 + t ** 3;
    const pose = poseAt(bones.get('センター'), 1000 * curve(100, 120));
    for (const value of pose.move) expect(value).toBeCloseTo(10 * curve(10, 30), 3);
    expect(2 * Math.asin(pose.turn[0])).toBeCloseTo(curve(10, 30), 3);
  });

  test('a file of the first version, whose model has a shorter name', () => {
    const keys = [...still, bend('上半身', X_AXIS, 0.4)];
    const bytes = writeVmd(keys);
    const first = Uint8Array.from([...bytes.subarray(0, 40), ...bytes.subarray(50)]);
    first.set(new TextEncoder().encode('Vocaloid Motion Data file\0'));
    expect(readVmd(first).localPoses([0])).toEqual(readVmd(bytes).localPoses([0]));
  });

  test('a body that stands still for more than a minute is refused', () => {
    const late = (frame: number): MadeKey[] => [...still, { bone: 'センター', frame }];
    expect(() => readVmd(writeVmd(late(1831)))).toThrow(/nothing moves for more than a minute/);
    expect(readVmd(writeVmd(late(1830))).frames).toBe(1831);
  });

  test('is a dancer of 1.60 m', async () => {
    const keys = [
      ...still,
      bend('上半身', X_AXIS, 0.2, 0),
      { bone: '左足ＩＫ', frame: 20, move: [0, 0.5, 0.5] as const },
    ];
    const file = await read({}, ['a.vmd', writeVmd(keys)]);
    expect(file.report).toMatchObject({
      format: 'VMD',
      convention: 'MMD',
      unit: 'MMD units of 8 cm',
      upAxis: 'y',
    });
    expect(MMD_JOINTS.length).toBeGreaterThan(file.report.estimated.length);
    expect(file.clip.positions[15 * 3 + 1]).toBeGreaterThan(1.2);
    expect(file.clip.positions[15 * 3 + 1]).toBeLessThan(1.5);
  });
});
