import { expect, test } from 'vitest';
import { leaderBvh } from '../../../support/leader-bvh';
import { writeBvh } from '../../../../../web/motion/bvh/write';
import { solve } from '../../../../../web/motion/fit/ik';
import { jointCount, jointText } from '../../../../../web/ui/files/joints/joint-text';
import { type BodyNames, madeBody, madeBvh, MIXAMO } from '../../../support/made-bvh';

const withoutToes: BodyNames = Object.fromEntries(
  Object.entries(MIXAMO).filter(([part]) => part !== 'toe'),
) as unknown as BodyNames;
const report = (names: BodyNames) => leaderBvh(madeBvh({ joints: madeBody(names) }).text).report;

test('a whole body with another number of spine joints lacks nothing', () => {
  for (const count of [1, 3, 5]) {
    const spine = Array.from({ length: count }, (_, i) => `mixamorig:Spine${i}`);
    const other = report({ ...MIXAMO, spine });
    expect(jointText(other)).toBe('all found; pelvis and spine placed along its back');
    expect(jointCount(other)).toBe(22);
  }
});

test('joints that are missing are named', () => {
  const lacking = report(withoutToes);
  expect(jointText(lacking)).toBe(
    '20 of 22 found; filled in: left foot, right foot; pelvis and spine placed along its back',
  );
  expect(jointCount(lacking)).toBe(20);
  const stiff = report({ ...MIXAMO, spine: [] });
  expect(jointText(stiff)).toBe('18 of 22 found; filled in: pelvis, spine1, spine2, spine3');
});

test('a file that this page wrote has all joints', () => {
  const { clip } = leaderBvh(madeBvh({ joints: madeBody(MIXAMO) }).text);
  const own = leaderBvh(writeBvh(solve(clip))).report;
  expect(jointText(own)).toBe('all 22 found');
});
