/** Joints that are set by hand, and remembered for a skeleton. */
import { describe, expect, test } from 'vitest';
import { inspectMotion } from '../../../../web/motion/import/inspect';
import { type FileBytes, readLeaderFile } from '../../../../web/motion/import/read';
import { distance, readVec } from '../../../../web/motion/math/vec3';
import { J, JOINT_COUNT, type JointName } from '../../../../web/motion/skeleton/skeleton';
import { type BodyNames, madeBody, madeBvh, MIXAMO } from '../../support/made-bvh';
import { bvhMotion, pairsOf, worstMillimetres } from '../../support/motion-files/made-motion';

/** Names that say nothing, on a body whose arms are too unlike to be found by their shape. */
const NAMES: BodyNames = {
  root: 'n0',
  spine: ['n1', 'n2', 'n3'],
  neck: 'n4',
  head: 'n5',
  sides: ['a', 'b'],
  hip: '*1',
  knee: '*2',
  ankle: '*3',
  toe: '*4',
  collar: '*5',
  shoulder: '*6',
  elbow: '*7',
  wrist: '*8',
};
const CHOICE = Object.fromEntries(pairsOf(NAMES)) as Readonly<Record<JointName, string>>;

const unlike = madeBody(NAMES).map((joint) =>
  joint.name === 'a7' ? { ...joint, offset: [0.12, 0, 0] as const } : joint,
);
const made = madeBvh({ joints: unlike });
const filesOf = (text: string): FileBytes[] => [{ name: 'a.bvh', bytes: new TextEncoder().encode(text) }];

describe('joints set by hand', () => {
  test('make a dancer of a file that is refused without them', async () => {
    await expect(readLeaderFile(filesOf(made.text))).rejects.toMatchObject({ code: 'missing-joints' });
    const file = await readLeaderFile(filesOf(made.text), { joints: CHOICE });
    expect(file.report).toMatchObject({ mappedBy: 'hand', joints: CHOICE });
    expect(worstMillimetres(file, bvhMotion(made, NAMES, 40))).toBeLessThan(0.05);
  });

  test('are remembered by the names of the skeleton, and no other skeleton gets them', async () => {
    const { skeleton } = await inspectMotion(filesOf(made.text));
    const remembered = { [skeleton]: CHOICE };
    const later = madeBvh({ joints: unlike, swing: 22, frames: 50 });
    const file = await readLeaderFile(filesOf(later.text), {}, remembered);
    expect(file.report).toMatchObject({ mappedBy: 'hand' });
    expect(worstMillimetres(file, bvhMotion(later, NAMES, 50))).toBeLessThan(0.05);
    const shown = await inspectMotion(filesOf(later.text), {}, remembered);
    expect(shown.joints[shown.found.left_wrist!]!.name).toBe(CHOICE.left_wrist);
    const other = await readLeaderFile(filesOf(madeBvh({ joints: madeBody(MIXAMO) }).text), {}, remembered);
    expect(other.report.mappedBy).toBe('names');
    // What is set for this file goes before what is remembered.
    const elsewhere = { ...CHOICE, left_wrist: 'b8' };
    const set = await readLeaderFile(filesOf(made.text), { joints: elsewhere }, remembered);
    expect(set.report.joints.left_wrist).toBe('b8');
  });

  test('with exchanged sides turn left into right, and the feet say so', async () => {
    const plain = madeBvh({ joints: madeBody(MIXAMO) });
    const found = await readLeaderFile(filesOf(plain.text));
    const exchanged = Object.fromEntries(
      pairsOf(MIXAMO).map(([joint, name]) => [
        joint,
        name.replace(/Left|Right/, (side) => (side === 'Left' ? 'Right' : 'Left')),
      ]),
    );
    const file = await readLeaderFile(filesOf(plain.text), { joints: exchanged });
    const at = (from: typeof file, joint: number): number[] =>
      [0, 2].map((axis) => from.clip.positions[3 * (20 * JOINT_COUNT + joint) + axis]!);
    expect(at(file, J.left_knee)).toEqual(at(found, J.right_knee));
    expect(file.report.warnings.join()).toContain('feet point backwards');
  });

  test.each([null, 'gone'])('that the file does not have are estimated: %s', async (neck) => {
    const file = await readLeaderFile(filesOf(made.text), { joints: { ...CHOICE, neck } });
    expect(file.report.joints.neck).toBeNull();
    expect(file.report.estimated).toContain('neck');
  });

  test('of the trunk are taken where all four are set', async () => {
    const part = { ...CHOICE, pelvis: 'n0', spine1: 'n1', spine2: 'n2' };
    const some = await readLeaderFile(filesOf(made.text), { joints: part });
    expect(some.report.estimated).toEqual(['pelvis', 'spine1', 'spine2', 'spine3']);
    expect(some.report.joints.pelvis).toBeNull();
    const all = await readLeaderFile(filesOf(made.text), { joints: { ...part, spine3: 'n3' } });
    expect(all.report).toMatchObject({ estimated: [], joints: { pelvis: 'n0', spine3: 'n3' } });
    const { positions } = all.clip;
    const back = distance(readVec(positions, J.pelvis), readVec(positions, J.spine1));
    expect(back).toBeCloseTo(0.125, 5);
  });
});

test.each([
  ['y', 'y'],
  ['z', 'z'],
] as const)('the joints of a file that stands with %s up are shown upright', async (up, expected) => {
  const { text } = madeBvh({ joints: madeBody(MIXAMO), up });
  expect((await inspectMotion(filesOf(text))).upAxis).toBe(expected);
});
