import { expect, test } from 'vitest';
import { readBvh } from '../../../../../web/motion/import/bvh/read';

const TURNS = 'CHANNELS 3 Zrotation Xrotation Yrotation';

/** Two arms below hips; the first may end in a site with channels. */
const arms = (endSite: string, frame: string): string => `HIERARCHY
ROOT Hips
{
OFFSET 0 0 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
JOINT Left
{
OFFSET 0 10 0
${TURNS}
End Site
{
OFFSET 0 5 0
${endSite}
}
}
JOINT Right
{
OFFSET 1 -10 0
${TURNS}
End Site
{
OFFSET 0 -5 0
}
}
}
MOTION
Frames: 2
Frame Time: 0.0333333
${frame}
${frame}
`;

test('channels of an end site do not shift the values of the joints after it', () => {
  const plain = readBvh(arms('', '0 0 0 0 0 0 10 0 0 50 0 0'));
  const [translations, rotations] = [
    plain.localPoses([0, 1]).translations,
    plain.localPoses([0, 1]).rotations,
  ];
  const turned = readBvh(arms(TURNS, '0 0 0 0 0 0 10 0 0 7 7 7 50 0 0')).localPoses([0, 1]);
  expect(turned.translations).toEqual(translations);
  const right = plain.joints.findIndex(({ name }) => name === 'Right');
  const quaternion = (of: Float32Array, joint: number): number[] => [
    ...of.subarray(4 * joint, 4 * joint + 4),
  ];
  for (const joint of [0, 1, right]) {
    expect(quaternion(turned.rotations, joint)).toEqual(quaternion(rotations, joint));
  }
});

test('position channels mean the same in every frame, however few are asked for', () => {
  // What is added to the OFFSET is near to it in the first frame and far from it in the others.
  const rows = ['0 10 0', ...Array.from({ length: 9 }, () => '0 1 0')].map((at) => `0 0 0 ${at}`);
  const source = readBvh(`HIERARCHY
ROOT Reference
{
OFFSET 0 0 0
${TURNS}
JOINT Hips
{
OFFSET 0 10 0
CHANNELS 3 Xposition Yposition Zposition
End Site
{
OFFSET 0 5 0
}
}
}
MOTION
Frames: 10
Frame Time: 0.0333333
${rows.join('\n')}
`);
  const heights = (frames: readonly number[]): number[] => {
    const { translations } = source.localPoses(frames);
    return frames.map((_, i) => translations[(3 * i + 1) * 3 + 1]!);
  };
  const all = heights([...rows.keys()]);
  expect(all).toEqual([20, 11, 11, 11, 11, 11, 11, 11, 11, 11]);
  rows.forEach((_, frame) => expect(heights([frame])).toEqual([all[frame]]));
});
