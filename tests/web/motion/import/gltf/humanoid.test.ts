import { expect, test } from 'vitest';
import type { Gltf } from '../../../../../web/motion/import/gltf/container';
import { humanoidNames } from '../../../../../web/motion/import/gltf/humanoid';

const namesOf = (key: string, humanBones: unknown): [number, string][] => [
  ...humanoidNames({ extensions: { [key]: { humanoid: { humanBones } } } } as unknown as Gltf),
];

test.each([
  ['VRMC_vrm', { hips: { node: 3 }, spine: { node: 4 } }],
  ['VRMC_vrm_animation', { hips: { node: 3 }, spine: { node: 4 } }],
  [
    'VRM',
    [
      { bone: 'hips', node: 3 },
      { bone: 'spine', node: 4 },
    ],
  ],
])('%s names the nodes of its bones', (key, bones) => {
  expect(namesOf(key, bones)).toEqual([
    [3, 'hips'],
    [4, 'spine'],
  ]);
});

test.each([
  ['VRMC_vrm', { hips: { node: 'x' }, spine: null, chest: { node: 5 } }],
  ['VRM', [{ bone: 'hips' }, null, { bone: 2, node: 4 }, { bone: 'chest', node: 5 }]],
])('%s with bones that are not as they should be: those are left out', (key, bones) => {
  expect(namesOf(key, bones)).toEqual([[5, 'chest']]);
});
