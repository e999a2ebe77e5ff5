/** Bones of VMD above the feet. */
import { expect, test } from 'vitest';
import { mmdBone } from '../../../../web/motion/import/vmd/body';
import { readVmd } from '../../../../web/motion/import/vmd/read';
import { distance, type Vec3 } from '../../../../web/motion/math/vec3';
import { worldPose } from '../../../../web/motion/retarget/sample';
import { type MadeKey, writeVmd } from '../../support/motion-files/vmd';

const still: MadeKey[] = [
  { bone: 'センター', frame: 0 },
  { bone: 'センター', frame: 30 },
];

/** Place of the left ankle in the first frame. */
function ankle(...keys: MadeKey[]): Vec3 {
  const source = readVmd(writeVmd([...still, ...keys]));
  return worldPose(source.joints, source.localPoses([0]), 0).places[mmdBone('左足首')]!;
}

test('a foot follows the parent of its IK bone, with and without keys of its own', () => {
  const move = [0, 2, 2] as const;
  const expected = ankle({ bone: '左足ＩＫ', frame: 0, move });
  expect(distance(expected, ankle())).toBeGreaterThan(1);
  const parent = { bone: '左足IK親', frame: 0, move };
  expect(distance(ankle(parent), expected)).toBeLessThan(1e-4);
  expect(distance(ankle(parent, { bone: '左足ＩＫ', frame: 0 }), expected)).toBeLessThan(1e-4);
});
