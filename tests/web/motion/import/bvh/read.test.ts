import { describe, expect, test } from 'vitest';
import type { LeaderFile } from '../../../../../web/motion/retarget/leader';
import { leaderBvh } from '../../../support/leader-bvh';
import { J, JOINT_COUNT, type JointName, SMPL22 } from '../../../../../web/motion/skeleton/skeleton';
import { distance, dot, lerp, readVec, sub, type Vec3 } from '../../../../../web/motion/math/vec3';
import { type BodyNames, madeBody, madeBvh, type MadeFile, MIXAMO } from '../../../support/made-bvh';
import { CONVENTIONS } from '../../../support/motion-files/conventions';
import { pairsOf } from '../../../support/motion-files/made-motion';
import { rotate } from '../../../../../web/motion/math/quat';
import { ALL_UNITS, UP_AXES } from '../../../../../web/motion/retarget/axes-and-units';

const joint = (file: LeaderFile, frame: number, name: JointName): Vec3 =>
  readVec(file.clip.positions, frame * JOINT_COUNT + J[name]);

/** How far the clip's floor lies from the made file's, the same in every frame and joint. */
function floorShift(file: LeaderFile, made: MadeFile, source: string): number {
  return made.at(source, 0)[1] - joint(file, 0, 'left_knee')[1];
}

function expectSame(
  file: LeaderFile,
  made: MadeFile,
  pairs: readonly (readonly [JointName, string])[],
  every = 1,
) {
  const knee = pairs.find(([name]) => name === 'left_knee')![1];
  const shift = floorShift(file, made, knee);
  for (let frame = 0; frame < file.clip.frames; frame++) {
    for (const [name, source] of pairs) {
      const [x, y, z] = made.at(source, frame * every);
      expect(distance(joint(file, frame, name), [x, y - shift, z])).toBeLessThan(2e-5);
    }
  }
}

const withFingers = CONVENTIONS.find(({ label }) => label === 'Character Creator')!.names;
const xsens = CONVENTIONS.find(({ label }) => label === 'Xsens MVN, BVH')!.names;

describe('skeleton conventions', () => {
  test('finger and twist joints do not change the result', () => {
    const names = withFingers;
    const plain = leaderBvh(madeBvh({ joints: madeBody(names), swing: 0 }).text);
    const extra = [
      { name: 'CC_Base_L_CalfTwist01', parent: 'CC_Base_L_Calf', offset: [0, -0.1, 0] as const },
      { name: 'CC_Base_L_Index1', parent: 'CC_Base_L_Hand', offset: [0.1, 0, 0] as const },
    ];
    const rich = leaderBvh(madeBvh({ joints: [...madeBody(names), ...extra], swing: 0 }).text);
    expect(rich.clip).toEqual(plain.clip);
  });

  test('joints of a rig beside those that deform the mesh', () => {
    const { names } = CONVENTIONS.find(({ label }) => label === 'Rigify, deform bones')!;
    const helpers = Array.from({ length: 8 }, (_, i) => ({
      name: `MCH-${i}`,
      parent: names.root,
      offset: [0, 0.02, 0] as const,
    }));
    const made = madeBvh({ joints: [...madeBody(names), ...helpers] });
    const file = leaderBvh(made.text);
    expect(file.report).toMatchObject({ convention: 'Rigify', mappedBy: 'names' });
    expectSame(file, made, pairsOf(names));
  });

  test('bones of unlike lengths on the two sides are doubted', () => {
    for (const [forearm, x] of [
      ['LeftForeArm', 0.18],
      ['RightForeArm', -0.18],
    ] as const) {
      const joints = madeBody(MIXAMO).map((one) =>
        one.name === `mixamorig:${forearm}` ? { ...one, offset: [x, 0, 0] as const } : one,
      );
      const { report } = leaderBvh(madeBvh({ joints }).text);
      expect(report.warnings).toEqual(['The left and the right upper arm differ in length by 33 %.']);
      expect(report.confidence).toBeCloseTo(2 / 3, 5);
    }
    expect(leaderBvh(madeBvh({ joints: madeBody(MIXAMO) }).text).report.confidence).toBe(1);
  });
});

describe('units and axes', () => {
  test.each([
    [1, 'metres'],
    [10, 'decimetres'],
    [100, 'centimetres'],
    [1 / 0.0254, 'inches'],
    [1000, 'millimetres'],
    [0.45 / 0.0254, 'CMU units of 5.64 cm'],
  ])('%d units per metre are %s', (unitsPerMetre, unit) => {
    const made = madeBvh({ joints: madeBody(MIXAMO), unitsPerMetre });
    const file = leaderBvh(made.text);
    expect(file.report.unit).toBe(unit);
    expectSame(file, made, pairsOf(MIXAMO));
  });

  test('a body that no unit fits is scaled to an adult, with a warning', () => {
    const file = leaderBvh(madeBvh({ joints: madeBody(MIXAMO), unitsPerMetre: 1e5 }).text);
    expect(file.report.unit).toBe('unknown unit');
    expect(file.report.warnings.join()).toMatch(/scaled/);
    const knee = distance(joint(file, 0, 'left_knee'), joint(file, 0, 'left_ankle'));
    expect(knee).toBeGreaterThan(0.3);
    expect(knee).toBeLessThan(0.5);
  });

  test.each(['y', 'z'] as const)('%s up', (up) => {
    const made = madeBvh({ joints: madeBody(MIXAMO), up });
    const file = leaderBvh(made.text);
    expect(file.report.upAxis).toBe(up);
    expectSame(file, made, pairsOf(MIXAMO));
    expect(joint(file, 0, 'head')[1]).toBeGreaterThan(1.2);
  });

  test.each(['y', 'z'] as const)('%s up, and a dancer who lies most of the time', (up) => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO), up });
    const [head, ...rows] = text.split(/(?<=Frame Time: .*\n)/);
    const frames = rows.join('').trim().split('\n');
    const lying = frames.map((row, frame) => {
      if (frame < 8) return row;
      const [x, y, z, ...angles] = row.split(' ').map(Number) as [number, number, number, ...number[]];
      // Falls onto the back, the feet where they were.
      const place = up === 'y' ? [x, 15, z - y] : [x, y + z, 15];
      return [...place, 0, -90, 0, ...angles.slice(3)].join(' ');
    });
    const file = leaderBvh([head, ...lying].join('\n'));
    expect(file.report).toMatchObject({ upAxis: up, warnings: [] });
    expect(joint(file, 0, 'head')[1]).toBeGreaterThan(1.2);
    expect(joint(file, 30, 'head')[1]).toBeLessThan(0.5);
  });

  test.each(UP_AXES)('$name up: the axis is turned upright', ({ axis, turn }) => {
    expect(distance(rotate(turn, axis), [0, 1, 0])).toBeLessThan(1e-12);
  });

  test('an up axis, a turn and a floor that are set by hand', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO) });
    const found = leaderBvh(text);
    const trunk = (file: LeaderFile): Vec3 => sub(joint(file, 9, 'head'), joint(file, 9, 'left_hip'));
    const [x, y, z] = trunk(found);
    const lying = leaderBvh(text, { up: 'z' });
    expect(lying.report.upAxis).toBe('z');
    expect(distance(trunk(lying), [x, z, -y])).toBeLessThan(1e-5);
    // From ahead to the dancer's left, seen from above against the clock.
    expect(distance(trunk(leaderBvh(text, { turn: 90 })), [z, y, -x])).toBeLessThan(1e-5);
    // A turn is about the vertical that was set.
    expect(distance(trunk(leaderBvh(text, { up: 'z', turn: 90 })), [-y, z, -x])).toBeLessThan(1e-5);
    const lower = leaderBvh(text, { floor: found.report.floor - 0.5 });
    expect(lower.report.floor).toBe(found.report.floor - 0.5);
    expect(joint(lower, 9, 'head')[1]).toBeCloseTo(joint(found, 9, 'head')[1] + 0.5, 5);
  });

  test.each(ALL_UNITS)('$name that are set by hand', ({ name, metres }) => {
    const made = madeBvh({ joints: madeBody(MIXAMO), unitsPerMetre: 1 / metres });
    const file = leaderBvh(made.text, { unit: name });
    expect(file.report).toMatchObject({ unit: name, warnings: [] });
    expectSame(file, made, pairsOf(MIXAMO));
  });

  test.each([
    ['feet', 0.3048],
    ['MMD units of 8 cm', 0.08],
  ] as const)('%s are %d m', (unit, metres) => {
    expect(ALL_UNITS.find(({ name }) => name === unit)!.metres).toBe(metres);
  });

  test('a unit that makes a giant is doubted', () => {
    const { report } = leaderBvh(madeBvh({ joints: madeBody(MIXAMO) }).text, { unit: 'inches' });
    expect(report.warnings.join()).toContain('In inches the dancer is larger than people are');
  });

  test('the floor is at 0: the toes of standing feet are three centimetres above it', () => {
    const file = leaderBvh(madeBvh({ joints: madeBody(MIXAMO), swing: 0 }).text);
    expect(joint(file, 0, 'left_foot')[1]).toBeCloseTo(0.03, 5);
  });
});

describe('time', () => {
  test.each([
    ['0.033333', 30],
    ['.0333333', 30],
    ['0.008333', 120],
    ['0.016667', 60],
    ['0.0166667', 60],
    ['0.01666', 60],
    ['0.04', 25],
    ['0.0333667', 1 / 0.0333667],
    ['8.33333e-3', 120],
  ])('a frame time of %s is %d frames per second', (frameTime, fps) => {
    const { report } = leaderBvh(madeBvh({ joints: madeBody(MIXAMO), frameTime, frames: 60 }).text);
    expect(report.sourceFps).toBeCloseTo(fps, 9);
  });

  test('a long dance is read completely', () => {
    const made = madeBvh({ joints: madeBody(MIXAMO), frames: 600 });
    expectSame(leaderBvh(made.text), made, pairsOf(MIXAMO));
  });

  test('120 frames per second give every fourth frame', () => {
    const made = madeBvh({ joints: madeBody(MIXAMO), frameTime: '0.00833333', frames: 121 });
    const file = leaderBvh(made.text);
    expect(file.clip.frames).toBe(31);
    expectSame(file, made, pairsOf(MIXAMO), 4);
  });

  test('a given frame rate replaces that of the header', () => {
    const made = madeBvh({ joints: madeBody(MIXAMO), frameTime: '0.00833333', frames: 121 });
    const file = leaderBvh(made.text, { fps: 60 });
    expect(file.report.sourceFps).toBe(60);
    expect(file.clip.frames).toBe(61);
    expectSame(file, made, pairsOf(MIXAMO), 2);
    const broken = made.text.replace('Frame Time: 0.00833333', 'Frame Time: 0');
    expect(leaderBvh(broken, { fps: 60 }).clip.frames).toBe(61);
  });

  test('between frames rotations are interpolated, so bones keep their lengths', () => {
    const made = madeBvh({ joints: madeBody(MIXAMO), frameTime: '0.1', frames: 12, swing: 60 });
    const file = leaderBvh(made.text);
    expect(file.clip.frames).toBe(34);
    for (let frame = 0; frame < file.clip.frames; frame++) {
      const shin = distance(joint(file, frame, 'left_knee'), joint(file, frame, 'left_ankle'));
      expect(shin).toBeCloseTo(0.41, 5);
    }
    const [start, third, end] = [0, 1, 3].map((frame) => joint(file, frame, 'left_wrist')) as [
      Vec3,
      Vec3,
      Vec3,
    ];
    expect(distance(third, lerp(start, end, 1 / 3))).toBeLessThan(0.2 * distance(start, end));
    // A body that does not turn goes straight from one place of its root to the next.
    const gliding = leaderBvh(madeBvh({ joints: madeBody(MIXAMO), frameTime: '0.1', swing: 0 }).text);
    const [from, between, to] = [0, 1, 3].map((frame) => joint(gliding, frame, 'head')) as [Vec3, Vec3, Vec3];
    expect(distance(from, to)).toBeGreaterThan(0.01);
    expect(distance(between, lerp(from, to, 1 / 3))).toBeLessThan(1e-5);
  });

  test('frames beyond the stated number are left out, with a warning', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 40 });
    const { clip, report } = leaderBvh(text.replace('Frames: 40', 'Frames: 35'));
    expect(clip.frames).toBe(35);
    expect(report.warnings).toEqual(['5 frames beyond the 35 that the file states were left out.']);
    const single = leaderBvh(text.replace('Frames: 40', 'Frames: 39')).report;
    expect(single.warnings).toEqual(['1 frame beyond the 39 that the file states was left out.']);
  });

  test('a dance at a multiple of its speed raises a warning', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO), frames: 400, swing: 25 });
    expect(leaderBvh(text).report).toMatchObject({ warnings: [], halfRate: null });
    const hurried = leaderBvh(text.replace(/(?<=Frame Time: ).*/, '0.008333')).report;
    expect(hurried.warnings.join()).toMatch(/frame rate of the file \(120\)/);
    expect(hurried.halfRate).toBe(60);
    // Whoever has set the rate is not asked to set another one.
    const set = leaderBvh(text, { fps: 120 }).report;
    expect(set.warnings.join()).toMatch(/frame rate of the file \(120\)/);
    expect(set.halfRate).toBeNull();
  });
});

describe('joints that the file does not have', () => {
  const without = (part: keyof BodyNames, names = MIXAMO): BodyNames =>
    Object.fromEntries(Object.entries(names).filter(([name]) => name !== part)) as unknown as BodyNames;
  const read = (names: BodyNames): LeaderFile => leaderBvh(madeBvh({ joints: madeBody(names) }).text);

  test.each([
    ['collar', ['left_collar', 'right_collar']],
    ['head', ['head']],
    ['neck', ['neck']],
  ] as const)('%s is placed near where it belongs', (part, made) => {
    const truth = read(MIXAMO);
    const file = read(without(part));
    expect(file.report.estimated).toEqual(expect.arrayContaining([...made]));
    for (const name of made) expect(file.report.joints[name]).toBeNull();
    const still = leaderBvh(madeBvh({ joints: madeBody(without(part)), swing: 0 }).text);
    const wanted = leaderBvh(madeBvh({ joints: madeBody(MIXAMO), swing: 0 }).text);
    for (const name of made)
      expect(distance(joint(still, 0, name), joint(wanted, 0, name))).toBeLessThan(0.04);
    expect(truth.report.estimated).toEqual(['pelvis', 'spine1', 'spine2', 'spine3']);
  });

  test('a head of an unknown name is the last joint of the single way above the neck', () => {
    const joints = madeBody(without('head')).concat(
      { name: 'mixamorig:Neck1', parent: 'mixamorig:Neck', offset: [0, 0.05, 0] },
      { name: 'mixamorig:Skull', parent: 'mixamorig:Neck1', offset: [0, 0.05, 0], end: [0, 0.15, 0] },
    );
    const { report } = leaderBvh(madeBvh({ joints }).text);
    expect(report.joints).toMatchObject({ neck: 'mixamorig:Neck', head: 'mixamorig:Skull' });
  });

  test('no joint of the file stands for two joints', () => {
    // With hands in place of wrists, so that only the convention fits in which a shoulder may be either joint.
    const file = read({ ...without('collar', xsens), wrist: '*Hand' });
    expect(file.report.joints).toMatchObject({ left_shoulder: 'LeftShoulder', left_collar: null });
    expect(distance(joint(file, 0, 'left_shoulder'), joint(file, 0, 'left_collar'))).toBeGreaterThan(0.05);
  });

  test('toes come from the end site of the foot', () => {
    const joints = madeBody(without('toe')).map((one) =>
      one.name.endsWith('Foot') ? { ...one, end: [0, -0.05, 0.12] as const } : one,
    );
    const made = madeBvh({ joints });
    const file = leaderBvh(made.text);
    expect(file.report.estimated).not.toContain('left_foot');
    expect(file.report.joints.left_foot).toBe('end of mixamorig:LeftFoot');
    expectSame(file, made, [
      ['left_knee', 'mixamorig:LeftLeg'],
      ['left_foot', 'end of mixamorig:LeftFoot'],
    ]);
  });

  test('a toe joint that lies on the ankle is no toe', () => {
    const joints = madeBody(MIXAMO).map((one) =>
      one.name.endsWith('ToeBase') ? { ...one, offset: [0, -0.001, 0] as const } : one,
    );
    const file = leaderBvh(madeBvh({ joints }).text);
    expect(file.report.estimated).toEqual(expect.arrayContaining(['left_foot', 'right_foot']));
    expect(file.report.joints.left_foot).toBeNull();
    expect(distance(joint(file, 0, 'left_foot'), joint(file, 0, 'left_ankle'))).toBeGreaterThan(0.08);
  });

  test.each(['y', 'z'] as const)(
    'without an end, toes are made ahead of the ankle and turn with it, %s up',
    (up) => {
      const made = madeBvh({ joints: madeBody(without('toe')), up });
      const file = leaderBvh(made.text);
      expect(file.report.estimated).toEqual(expect.arrayContaining(['left_foot', 'right_foot']));
      const ended = madeBody(without('toe')).map((one) =>
        one.name.endsWith('Foot') ? { ...one, end: [0, -0.05, 0.12] as const } : one,
      );
      const truth = leaderBvh(madeBvh({ joints: ended, up }).text);
      const foot = (from: LeaderFile, frame: number): Vec3 =>
        sub(joint(from, frame, 'left_foot'), joint(from, frame, 'left_ankle'));
      const angles = Array.from({ length: file.clip.frames }, (_, frame) =>
        dot(foot(file, frame), foot(truth, frame)),
      );
      expect(Math.min(...angles)).toBeGreaterThan(0.9 * 0.099 * 0.13);
      expect(Math.max(...angles) - Math.min(...angles)).toBeLessThan(1e-6);
      const still = leaderBvh(madeBvh({ joints: madeBody(without('toe')), up, swing: 0 }).text);
      const [x, y, z] = joint(still, 0, 'right_ankle');
      const [toeX, toeY, toeZ] = joint(still, 0, 'right_foot');
      expect(toeX).toBeCloseTo(x, 4);
      expect(y - toeY).toBeGreaterThan(0.02);
      expect(toeZ - z).toBeGreaterThan(0.07);
    },
  );

  test.each([0, 1, 2, 5])('a back of %i joints is divided like the others', (count) => {
    const spine = Array.from({ length: count }, (_, i) => `mixamorig:Spine${i}`);
    const file = leaderBvh(madeBvh({ joints: madeBody({ ...MIXAMO, spine }), swing: 0 }).text);
    const hips = joint(file, 0, 'left_hip')[1];
    const neck = joint(file, 0, 'neck')[1];
    const shares = (['pelvis', 'spine1', 'spine2', 'spine3'] as const).map(
      (name) => (joint(file, 0, name)[1] - hips) / (neck - hips),
    );
    [0.18, 0.4, 0.61, 0.72].forEach((share, i) => expect(shares[i]).toBeCloseTo(share, 4));
  });
});

describe('variants of the format', () => {
  test.each(['whole', 'added'] as const)('positions below the root that are %s', (positions) => {
    const made = madeBvh({ joints: madeBody(MIXAMO), positions });
    expectSame(leaderBvh(made.text), made, pairsOf(MIXAMO));
  });

  test('line ends, byte order mark, lower case, braces on the line of the name', () => {
    const made = madeBvh({ joints: madeBody(MIXAMO), newline: '\r\n' });
    expectSame(leaderBvh('\uFEFF' + made.text), made, pairsOf(MIXAMO));
    const odd = made.text
      .replaceAll(/\r\n(\t*){/g, ' {')
      .replaceAll('OFFSET', 'offset')
      .replaceAll('Zrotation', 'ZROTATION');
    expectSame(leaderBvh(odd), made, pairsOf(MIXAMO));
  });

  test('swapped left and right are corrected, with a warning', () => {
    const swapped = { ...MIXAMO, sides: ['Right', 'Left'] as const };
    const made = madeBvh({ joints: madeBody(swapped) });
    const file = leaderBvh(made.text);
    expect(file.report.warnings.join()).toMatch(/left and right of this file were swapped/);
    expect(file.report.joints.left_knee).toBe('mixamorig:RightLeg');
    expectSame(file, made, pairsOf(swapped));
  });

  test('every joint is in the report', () => {
    const { report } = leaderBvh(madeBvh({ joints: madeBody(MIXAMO) }).text);
    expect(Object.keys(report.joints)).toEqual([...SMPL22]);
  });
});

describe('several roots', () => {
  /** One file with the dancers of several: their skeletons after one another, and their frames side by side. */
  const together = (...texts: string[]): string => {
    const parts = texts.map((text) => text.split('MOTION\n') as [string, string]);
    const rows = parts.map(([, motion]) => motion.split('\n').slice(2));
    const skeletons = parts.map(([skeleton], i) =>
      i === 0 ? skeleton : skeleton.replace('HIERARCHY\n', ''),
    );
    const head = parts[0]![1].split('\n').slice(0, 2);
    const lines = rows[0]!.map((_, frame) => rows.map((one) => one[frame]!).join(' '));
    return [`${skeletons.join('')}MOTION`, ...head, ...lines].join('\n');
  };
  const prop =
    'HIERARCHY\nROOT Stick\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n}\nMOTION\n';
  const stick = `${prop}Frames: 40\nFrame Time: 0.0333333\n${'900 900 900\n'.repeat(40)}`;
  const names = { ...MIXAMO, root: 'mixamorig:Other' };

  test('one of two dancers is chosen', () => {
    const [a, b] = [
      madeBvh({ joints: madeBody(MIXAMO) }),
      madeBvh({ joints: madeBody(names), swing: 22, unitsPerMetre: 100 }),
    ] as const;
    const text = together(a.text, b.text);
    expectSame(leaderBvh(text), a, pairsOf(MIXAMO));
    const second = leaderBvh(text, { part: 1 });
    expectSame(second, b, pairsOf(names));
    expect(second.report).toMatchObject({ part: 1, parts: ['mixamorig:Hips', 'mixamorig:Other'] });
  });

  test('a prop beside the dancer is left out, before or after it', () => {
    const made = madeBvh({ joints: madeBody(MIXAMO) });
    for (const text of [together(made.text, stick), together(stick, made.text)])
      expectSame(leaderBvh(text), made, pairsOf(MIXAMO));
  });
});
