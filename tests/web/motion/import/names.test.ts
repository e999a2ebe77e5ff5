/** What programs write before and after the names of joints. */
import { expect, test } from 'vitest';
import { readLeaderFile } from '../../../../web/motion/import/read';
import { CONVENTIONS } from '../../support/motion-files/conventions';
import { writeGlb } from '../../support/motion-files/glb';
import { madeMotion, pairsOf, worstMillimetres } from '../../support/motion-files/made-motion';

const WORST = 0.05;
const named = CONVENTIONS.filter(({ reported }) => reported !== 'found by shape');

test.each([
  'Character1_',
  'dancer:',
  'dancer:Character1_',
  'group|dancer:',
  'ns1:ns2:Character1_',
  'Model_Anna_',
  'Anna|',
])('joints are found by their names after %s', async (prefix) => {
  const { names } = CONVENTIONS.find(({ label }) => label === 'LaFAN1')!;
  const motion = madeMotion({ names });
  const joints = motion.joints.map((joint) => ({ ...joint, name: prefix + joint.name }));
  const file = await readLeaderFile([{ name: 'a.glb', bytes: writeGlb({ ...motion, joints }) }]);
  expect(file.report).toMatchObject({ convention: 'CMU / MotionBuilder', mappedBy: 'names', warnings: [] });
  expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
});

test.each(named)('joints are found by their names before a number: $label', async ({ names, reported }) => {
  const motion = madeMotion({ names });
  const joints = motion.joints.map((joint, i) => ({ ...joint, name: `${joint.name}_0${i + 55}` }));
  const file = await readLeaderFile([
    { name: 'a.glb', bytes: writeGlb({ ...motion, joints }, { armature: true }) },
  ]);
  expect(file.report).toMatchObject({ convention: reported, mappedBy: 'names', warnings: [] });
  for (const [joint, name] of pairsOf(names))
    expect(file.report.joints[joint]).toMatch(new RegExp(`^${name}_0\\d+$`));
  expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
});
