/** Skeletons as programs other than the usual ones write them: their shape, with joints at known places. */
import { describe, expect, test } from 'vitest';
import { leaderBvh } from '../../support/leader-bvh';
import { madeBody, madeBvh, type MadeJoint, MIXAMO } from '../../support/made-bvh';
import { CONVENTIONS } from '../../support/motion-files/conventions';
import { J, JOINT_COUNT, type JointName } from '../../../../web/motion/skeleton/skeleton';
import { distance, readVec } from '../../../../web/motion/math/vec3';

const xsens = CONVENTIONS.find(({ label }) => label === 'Xsens MVN, BVH')!.names;

/** A body with some joints renamed. */
const renamed = (body: readonly MadeJoint[], names: Readonly<Record<string, string>>): MadeJoint[] =>
  body.map((joint) => ({
    ...joint,
    name: names[joint.name] ?? joint.name,
    parent: joint.parent === null ? null : (names[joint.parent] ?? joint.parent),
  }));

/** Largest distance of a joint from its place in the made file, the floor apart, metres. */
function worst(body: readonly MadeJoint[], pairs: Readonly<Partial<Record<JointName, string>>>): number {
  const made = madeBvh({ joints: body });
  const { clip } = leaderBvh(made.text);
  const at = (joint: JointName, frame: number) => readVec(clip.positions, frame * JOINT_COUNT + J[joint]);
  const shift = made.at(xsens.knee!.replace('*', 'Left'), 0)[1] - at('left_knee', 0)[1];
  let most = 0;
  for (let frame = 0; frame < clip.frames; frame++)
    for (const [joint, name] of Object.entries(pairs)) {
      const [x, y, z] = made.at(name, frame);
      most = Math.max(most, distance(at(joint as JointName, frame), [x, y - shift, z]));
    }
  return most;
}

describe('joints beside those of a known convention', () => {
  const toes = { LeftToe: 'LeftForefoot', RightToe: 'RightForefoot' };

  test('the only joint below an ankle is the toe, whatever it is called', () => {
    const body = renamed(madeBody(xsens), toes);
    const { report } = leaderBvh(madeBvh({ joints: body }).text);
    expect(report.joints).toMatchObject({ left_foot: 'LeftForefoot', right_foot: 'RightForefoot' });
    expect(worst(body, { left_foot: 'LeftForefoot', right_foot: 'RightForefoot' })).toBeLessThan(2e-5);
  });

  test('of several joints below an ankle the one that is called a toe is taken, else none', () => {
    const heels = ['Left', 'Right'].map((side) => ({
      name: `${side}Heel`,
      parent: `${side}Ankle`,
      offset: [0, -0.07, -0.06] as const,
    }));
    const named = renamed(madeBody(xsens), { LeftToe: 'LeftBigToe', RightToe: 'RightBigToe' });
    const { report } = leaderBvh(madeBvh({ joints: [...named, ...heels] }).text);
    expect(report.joints).toMatchObject({ left_foot: 'LeftBigToe', right_foot: 'RightBigToe' });
    const helpers = heels.map((heel) => ({ ...heel, name: heel.name.replace('Heel', 'Helper') }));
    const unnamed = [...renamed(madeBody(xsens), toes), ...helpers];
    expect(leaderBvh(madeBvh({ joints: unnamed }).text).report.estimated).toContain('left_foot');
    // A heel alone is no toe: the feet would point backwards.
    const { toe, ...names } = xsens;
    expect(toe).toBeDefined();
    const alone = leaderBvh(madeBvh({ joints: [...madeBody(names), ...heels] }).text).report;
    expect(alone).toMatchObject({ warnings: [], joints: { left_knee: 'LeftKnee', left_foot: null } });
  });

  test('a toe that was set to be estimated stays so', () => {
    const { text } = madeBvh({ joints: madeBody(MIXAMO) });
    const joints = { left_foot: null, right_foot: null };
    expect(leaderBvh(text, { joints }).report.estimated).toContain('left_foot');
  });

  test('the joint above the neck is the head, whatever it is called', () => {
    const body = renamed(madeBody(xsens), { Head: 'Neck1' });
    const { report } = leaderBvh(madeBvh({ joints: body }).text);
    expect(report.joints.head).toBe('Neck1');
    expect(worst(body, { head: 'Neck1' })).toBeLessThan(2e-5);
  });
});

test('hips that walk away below a root stay where their channels put them', () => {
  const made = madeBvh({ joints: madeBody(MIXAMO), positions: 'whole' });
  // A root that never moves, and hips whose OFFSET is where they once stood: 90 cm high, three metres away.
  const [, body] = made.text.split(/^ROOT \S+\s*\{\s*OFFSET [^\n]*\n/m) as [string, string];
  const hips = MIXAMO.root;
  const text = [
    `HIERARCHY\nROOT all\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation`,
    `JOINT ${hips}\n{\nOFFSET 10 90 -300\n${body.replace(/^MOTION/m, '}\nMOTION')}`,
  ]
    .join('\n')
    .replace(/^(-?[\d.]+ ){6}/gm, (values) => `0 0 0 0 0 0 ${values}`);
  const [plain, below] = [leaderBvh(made.text), leaderBvh(text)];
  expect(below.report.floor).toBeCloseTo(plain.report.floor, 4);
  below.clip.positions.forEach((value, i) => expect(value).toBeCloseTo(plain.clip.positions[i]!, 4));
});
