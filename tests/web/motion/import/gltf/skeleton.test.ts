/** Which nodes are joints where some hold meshes, and bones of a humanoid below nodes that are none. */
import { expect, test } from 'vitest';
import type { Gltf } from '../../../../../web/motion/import/gltf/container';
import { onBody } from '../../../../../web/motion/import/gltf/on-body';
import { skeletonOf } from '../../../../../web/motion/import/gltf/skeleton';
import { sourceOfPositions } from '../../../../../web/motion/import/positions';

const fileOf = (nodes: readonly object[], more: object = {}): Gltf =>
  ({
    nodes: nodes.map((node) => ({ children: [], ...node })),
    skins: [],
    extensions: {},
    ...more,
  }) as unknown as Gltf;

test('a mesh is a joint where joints hang on it or a VRM names it, and else none beside those of a skin', () => {
  const file = fileOf(
    [{ mesh: 0, children: [1] }, { name: 'hips' }, { mesh: 1 }, { mesh: 2, name: 'hips' }],
    {
      skins: [{ joints: [1] }],
    },
  );
  expect(skeletonOf(file, new Map([[2, 'head']])).nodes).toEqual([0, 1, 2]);
  expect(skeletonOf(file, new Map()).nodes).toEqual([0, 1]);
});

test('a bone of a humanoid hangs on the next bone above it, not on what lies between', () => {
  const humanBones = { hips: { node: 1 }, spine: { node: 3 } };
  const nodes = [
    { children: [1] },
    { children: [2], translation: [0, 1, 0] },
    { children: [3], translation: [0, 0.1, 0] },
    { translation: [0, 0.2, 0] },
  ];
  const body = fileOf(nodes, { extensions: { VRMC_vrm: { humanoid: { humanBones } } } });
  const joints = ['hips', 'spine'].map((name, i) => ({ name, parent: i - 1 }));
  const places = Float32Array.of(0, 2, 0, 0, 2.4, 0, 1, 2, 0, 1, 2.4, 0);
  const about = { format: 'VRMA', frameRate: () => 30, rateAssumed: false, unit: null, upAxis: 'y' } as const;
  const source = sourceOfPositions({ joints, places }, about);
  const bones = new Map([
    ['hips', 0],
    ['spine', 1],
  ]);
  const moved = onBody(source, body, bones);
  expect(moved.joints).toEqual(joints);
  // Hips of half the height go half as far.
  [0.5, 1, 0, 0, 0.3, 0].forEach((value, i) => {
    expect(moved.localPoses([1]).translations[i]).toBeCloseTo(value, 6);
  });
});
