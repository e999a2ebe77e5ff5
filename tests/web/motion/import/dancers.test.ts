/** Files in which one object holds several dancers, as exporters write them below a scene's root. */
import { describe, expect, test } from 'vitest';
import { readLeaderFile } from '../../../../web/motion/import/read';
import type { LeaderFile } from '../../../../web/motion/retarget/leader';
import { processorTimer } from '../../support/processor-time';
import { madeBody, madeBvh, type MadeJoint, MIXAMO } from '../../support/made-bvh';
import { changedGlb, joinClips, joinedGlb, writeGlb } from '../../support/motion-files/glb';
import {
  bvhMotion,
  madeMotion,
  type MadeMotion,
  worstMillimetres,
} from '../../support/motion-files/made-motion';

/** Largest error that is accepted, millimetres: the formats have single precision. */
const WORST = 0.05;

const dance = madeMotion();
const other = madeMotion({ swing: 30 });
const ways = [
  ['of known names', (motion: MadeMotion) => motion],
  [
    'of unknown names',
    (motion: MadeMotion) => ({
      ...motion,
      joints: motion.joints.map((joint, i) => ({ ...joint, name: `骨${i}` })),
    }),
  ],
] as const;

const read = (bytes: Uint8Array, part = 0, name = 'a.glb'): Promise<LeaderFile> =>
  readLeaderFile([{ name, bytes }], { part });

/** Two dancers below two objects below one, `RootNode`. */
function duetOf(rename: (motion: MadeMotion) => MadeMotion): Uint8Array<ArrayBuffer> {
  const [first, second] = ([dance, other] as const).map((motion, i) =>
    writeGlb(rename(motion), { armature: true, clips: [i === 0 ? 'leader' : 'follower'] }),
  ) as [Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>];
  return changedGlb(joinedGlb(first, second), ({ nodes, scenes }) => {
    scenes[0]!.nodes.forEach((node, i) => (nodes[node]!.name = `dancer ${i}`));
    nodes.push({ name: 'RootNode', children: scenes[0]!.nodes });
    scenes[0]!.nodes = [nodes.push({ name: 'Scene', children: [nodes.length - 1] }) - 1];
  });
}

describe.each(ways)('two dancers below one root, %s', (_, rename) => {
  const duet = duetOf(rename);

  test('every clip is read with the dancer that it moves', async () => {
    for (const [part, motion] of [dance, other].entries()) {
      const file = await read(duet, part);
      expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
      expect(file.report).toMatchObject({ parts: ['leader', 'follower'], part });
    }
  });

  test('one clip moves both, who can be chosen', async () => {
    const together = changedGlb(duet, joinClips);
    for (const [part, motion] of [dance, other].entries()) {
      const file = await read(together, part);
      expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
      expect(file.report).toMatchObject({ parts: ['dancer 0', 'dancer 1'], part });
    }
  });
});

test('a BVH file whose root is a scene of two dancers', async () => {
  const made = [madeBvh({ joints: madeBody(MIXAMO) }), madeBvh({ joints: madeBody(MIXAMO), swing: 22 })];
  const parts = made.map(({ text }) => text.split('MOTION\n') as [string, string]);
  const hierarchies = parts.map(([hierarchy]) =>
    hierarchy.replace('HIERARCHY\n', '').replace('ROOT', 'JOINT'),
  );
  const [head, rows] = [
    parts[0]![1].split('\n').slice(0, 2),
    parts.map(([, rest]) => rest.split('\n').slice(2)),
  ];
  const frames = rows[0]!.map((row, frame) => `${row} ${rows[1]![frame]!}`);
  const scene = ['HIERARCHY', 'ROOT scene', '{', 'OFFSET 0 0 0', 'CHANNELS 0', ...hierarchies, '}', 'MOTION'];
  const bytes = new TextEncoder().encode([...scene, ...head, ...frames].join('\n'));
  for (const [part, one] of made.entries()) {
    const file = await read(bytes, part, 'a.bvh');
    expect(worstMillimetres(file, bvhMotion(one, MIXAMO, 40))).toBeLessThan(WORST);
  }
});

test('hands with fingers are no dancers, and no part of a body is', async () => {
  const hand = (side: 'Left' | 'Right', x: number): MadeJoint[] =>
    [0, 1, 2, 3, 4].flatMap((finger) =>
      [0, 1, 2, 3].map((bone): MadeJoint => ({
        name: `${side} finger ${finger} ${bone}`,
        parent: bone === 0 ? `mixamorig:${side}Hand` : `${side} finger ${finger} ${bone - 1}`,
        offset:
          finger === 0
            ? [0.02 * x, 0.01, 0.05]
            : bone === 0
              ? [0.09 * x, 0.004 * finger, 0.06 - 0.025 * finger]
              : [(0.034 + 0.001 * finger) * x, 0, 0],
      })),
    );
  const body = [...madeBody(MIXAMO), ...hand('Left', 1), ...hand('Right', -1)];
  for (const [, rename] of ways) {
    const motion = madeMotion({ body });
    const { report } = await read(writeGlb(rename(motion), { armature: true }));
    expect(report.parts).toEqual([]);
  }
});

test.each([
  ['a chain', 1],
  ['a chain with a dozen joints at every joint', 13],
])('%s of thousands of nodes is read within two seconds', async (_, step) => {
  const bytes = changedGlb(writeGlb(dance), ({ nodes }) => {
    let end = nodes.at(-1)!;
    const hang = (parent: typeof end): typeof end => {
      const child = { name: `d${nodes.length}` };
      (parent.children ??= []).push(nodes.push(child) - 1);
      return child;
    };
    while (nodes.length < 4900) {
      let side = end;
      for (let i = 1; i < step; i++) side = hang(side);
      end = hang(end);
    }
  });
  const seconds = processorTimer();
  expect(worstMillimetres(await read(bytes), dance)).toBeLessThan(WORST);
  expect(seconds()).toBeLessThan(2);
});
