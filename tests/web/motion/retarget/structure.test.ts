import { describe, expect, test } from 'vitest';
import type { SourceJoint } from '../../../../web/motion/retarget/source';
import { mapJoints } from '../../../../web/motion/retarget/joint-map';
import { mapByStructure } from '../../../../web/motion/retarget/structure';
import { add, type Vec3, ZERO } from '../../../../web/motion/math/vec3';
import { leaderBvh } from '../../support/leader-bvh';
import { type BodyNames, type MadeJoint, madeBody, madeBvh, MIXAMO } from '../../support/made-bvh';

/** Joints with names that say nothing, where they rest, and which joint each was. */
function unnamed(body: readonly MadeJoint[], rename: (name: string, index: number) => string) {
  const joints: SourceJoint[] = [];
  const places: Vec3[] = [];
  const truth: string[] = [];
  const visit = (name: string | null, parent: number): void => {
    for (const joint of body.filter((one) => one.parent === name)) {
      const index = joints.push({ name: rename(joint.name, joints.length), parent }) - 1;
      places.push(add(parent < 0 ? ZERO : places[parent]!, joint.offset));
      truth.push(joint.name);
      if (joint.end) {
        joints.push({ name: 'end', parent: index, endSite: true });
        places.push(add(places[index]!, joint.end));
        truth.push(`end of ${joint.name}`);
      }
      visit(joint.name, index);
    }
  };
  visit(null, -1);
  return { joints, places, truth };
}

const EXPECTED = {
  left_hip: 'LeftUpLeg',
  left_knee: 'LeftLeg',
  left_ankle: 'LeftFoot',
  left_foot: 'LeftToeBase',
  left_collar: 'LeftShoulder',
  left_shoulder: 'LeftArm',
  left_elbow: 'LeftForeArm',
  left_wrist: 'LeftHand',
} as const;

function expectBody(
  body: readonly MadeJoint[],
  places?: (place: Vec3) => Vec3,
  rename: (name: string, index: number) => string = (_, index) => `骨${index}`,
): void {
  const made = unnamed(body, rename);
  const found = mapByStructure(made.joints, places ? made.places.map(places) : made.places);
  expect(found).not.toBeNull();
  for (const [joint, name] of Object.entries(EXPECTED)) {
    const right = joint.replace('left', 'right');
    const at = (key: string): string => made.truth[found!.nodes.get(key as 'left_hip') ?? -1] ?? 'none';
    expect([at(joint), at(right)]).toEqual([
      `mixamorig:${name}`,
      `mixamorig:${name.replace('Left', 'Right')}`,
    ]);
  }
  expect(made.truth[found!.nodes.get('head')!]).toBe('mixamorig:Head');
  expect(found!.sidesCertain).toBe(true);
}

const body = madeBody(MIXAMO);

describe('a body found by its shape', () => {
  test('in a T-pose', () => expectBody(body));

  test('with z up, turned and small', () => expectBody(body, ([x, y, z]) => [0.01 * z, 0.01 * x, 0.01 * y]));

  test('with fingers, hair and a tail', () => {
    const side = (name: string): number => (name.includes('Left') ? 1 : -1);
    const hands = body.filter(({ name }) => name.endsWith('Hand'));
    const fingers = hands.flatMap(({ name }) =>
      [0, 1, 2, 3].flatMap((finger): MadeJoint[] => [
        { name: `${name}${finger}`, parent: name, offset: [side(name) * 0.09, 0, 0.03 * finger] },
        { name: `${name}${finger}b`, parent: `${name}${finger}`, offset: [side(name) * 0.04, 0, 0] },
        { name: `${name}${finger}c`, parent: `${name}${finger}b`, offset: [side(name) * 0.03, 0, 0] },
      ]),
    );
    const chain = (name: string, parent: string, step: readonly [number, number, number], count: number) =>
      Array.from({ length: count }, (_, i): MadeJoint => ({
        name: `${name}${i}`,
        parent: i === 0 ? parent : `${name}${i - 1}`,
        offset: step,
      }));
    expectBody([
      ...body,
      ...fingers,
      ...chain('hair', 'mixamorig:Head', [0, -0.05, -0.05], 8),
      ...chain('tail', 'mixamorig:Hips', [0, -0.02, -0.12], 7),
    ]);
  });

  test('with a joint at the crown, and without a neck', () => {
    const bare = body.map(({ name, parent, offset }): MadeJoint => ({ name, parent, offset }));
    expectBody([...bare, { name: 'crown', parent: 'mixamorig:Head', offset: [0, 0.15, 0] }]);
    const neckless = madeBody(
      Object.fromEntries(Object.entries(MIXAMO).filter(([part]) => part !== 'neck')) as unknown as BodyNames,
    );
    expectBody(neckless);
  });

  test('whose neck begins at the place of the chest', () =>
    expectBody(
      body.map((joint) => (joint.name.endsWith('Neck') ? { ...joint, offset: [0, 0, 0] as const } : joint)),
    ));

  test('has no head where what hangs on the chest goes down', () => {
    const cloaked = [
      ...body.filter(({ name }) => !/Neck|Head/.test(name)),
      { name: 'cloak', parent: 'mixamorig:Spine2', offset: [0, -0.1, -0.1] as const },
    ];
    const made = unnamed(cloaked, (_, index) => `${index}`);
    const { nodes } = mapByStructure(made.joints, made.places)!;
    expect([nodes.has('left_wrist'), nodes.has('neck'), nodes.has('head')]).toEqual([true, false, false]);
  });

  test('whose root is in the chest', () => {
    const chest = 'mixamorig:Spine2';
    const trunk = [chest, 'mixamorig:Spine1', 'mixamorig:Spine', 'mixamorig:Hips'];
    const above = trunk.map((name) => body.find((joint) => joint.name === name)!.offset);
    expectBody(
      body.map((joint): MadeJoint => {
        const at = trunk.indexOf(joint.name);
        if (at < 0) return joint;
        const [x, y, z] = at === 0 ? ([0, -1.3, 0] as const) : above[at - 1]!;
        return { name: joint.name, parent: trunk[at - 1] ?? null, offset: [-x, -y, -z] };
      }),
    );
  });

  test('whose sides nothing tells is doubted', () => {
    const names: BodyNames = {
      ...{ root: 'n0', spine: ['n1', 'n2', 'n3'], neck: 'n4', head: 'n5', sides: ['a', 'b'] },
      ...{ hip: '*1', knee: '*2', ankle: '*3', collar: '*5', shoulder: '*6', elbow: '*7', wrist: '*8' },
    };
    const { report } = leaderBvh(madeBvh({ joints: madeBody(names) }).text);
    expect(report.warnings).toEqual([
      'Not all joints have known names; the body was found by its shape.',
      'Nothing tells left from right in this file; they may be exchanged.',
    ]);
    expect(report.confidence).toBeCloseTo(0.4, 5);
  });

  test('names decide between left and right where there are no feet', () => {
    const barefoot = body
      .filter(({ name }) => !name.endsWith('ToeBase'))
      .map((joint) => (joint.name.endsWith('Foot') ? { ...joint, end: [0, -0.05, 0] as const } : joint));
    const made = unnamed(barefoot, (name, index) => `${name.includes('Left') ? 'L' : 'R'}_${index}`);
    const found = mapByStructure(made.joints, made.places)!;
    expect(made.truth[found.nodes.get('left_knee')!]).toBe('mixamorig:LeftLeg');
    const nameless = unnamed(barefoot, (_, index) => `${index}`);
    expect(mapByStructure(nameless.joints, nameless.places)!.sidesCertain).toBe(false);
  });

  /** The body with a joint in the middle of every long bone, which turns with the joint at the bone's beginning. */
  const inHalves = (): MadeJoint[] =>
    body.flatMap((joint): MadeJoint[] => {
      if (!/(Left|Right)(Leg|Foot|ForeArm|Hand)$/.test(joint.name)) return [joint];
      const half = `${joint.parent!} half`;
      const offset = joint.offset.map((value) => value / 2) as unknown as MadeJoint['offset'];
      return [
        { name: half, parent: joint.parent, offset },
        { ...joint, parent: half, offset },
      ];
    });

  test.each([
    ['numbers', '_07', '_08'],
    ['numbers of bones', '.01', '.02'],
    ['words', '', 'Roll'],
  ])('with bones in halves that %s tell from one another', (_, first, second) => {
    const letters = 'abcdefghijklmnopqrstuvwxyz';
    const name = (bone: string): string => `骨${letters[body.findIndex((joint) => joint.name === bone)]!}`;
    expectBody(inHalves(), undefined, (joint) =>
      joint.endsWith(' half') ? name(joint.slice(0, -5)) + second : name(joint) + first,
    );
  });

  test('with numbers alone for names', () => expectBody(body, undefined, (_, index) => `Bone.${index}`));

  test('whose legs and arms are too short is doubted: they may be halves of bones', () => {
    const made = unnamed(inHalves(), (_, index) => `骨${index}`);
    const { doubts } = mapJoints(made.joints, made.places);
    expect(doubts.join()).toMatch(/The legs are too short .*The arms are too short/);
    const whole = unnamed(body, (_, index) => `骨${index}`);
    expect(mapJoints(whole.joints, whole.places).doubts).toHaveLength(1);
  });

  test('whose names and feet disagree about the sides is doubted', () => {
    const swapped = unnamed(body, (name, index) => `${name.includes('Left') ? 'right' : 'left'} ${index}`);
    const { doubts, nodes } = mapJoints(swapped.joints, swapped.places);
    expect(doubts.join()).toContain('Names and feet disagree about left and right; the feet were used');
    expect(swapped.truth[nodes.get('left_knee')!]).toBe('mixamorig:LeftLeg');
    const agreed = unnamed(body, (name, index) => `${name.includes('Left') ? 'left' : 'right'} ${index}`);
    expect(mapJoints(agreed.joints, agreed.places).doubts).toHaveLength(1);
  });

  /** The body without names whose bones that end at some joints are so many times as long. */
  const scaled = (part: RegExp, factor: number) =>
    unnamed(
      body.map((joint) =>
        part.test(joint.name)
          ? {
              ...joint,
              offset: joint.offset.map((value) => value * factor) as unknown as MadeJoint['offset'],
            }
          : joint,
      ),
      (_, index) => `骨${index}`,
    );

  test('whose left arm is a tenth shorter is less certain', () => {
    const made = scaled(/Left(ForeArm|Hand)$/, 0.9);
    expect(mapJoints(made.joints, made.places).confidence).toBeCloseTo(0.8 * 0.9, 5);
  });

  test.each([
    ['a left arm a quarter shorter', /Left(ForeArm|Hand)$/, 0.75],
    ['arms of a tenth of the length', /(ForeArm|Hand)$/, 0.1],
  ])('none with %s', (_, part, factor) => {
    const made = scaled(part, factor);
    expect(mapByStructure(made.joints, made.places)).toBeNull();
  });

  test.each(['UpLeg', 'Arm', 'Hand'])('none without its %s', (part) => {
    const lost = new Set<string>();
    for (const { name, parent } of body)
      if (new RegExp(`(Left|Right)${part}$`).test(name) || lost.has(parent ?? '')) lost.add(name);
    const made = unnamed(
      body.filter(({ name }) => !lost.has(name)),
      (_, index) => `${index}`,
    );
    expect(mapByStructure(made.joints, made.places)).toBeNull();
  });
});
