/** Formats by conventions: for every cell a file of known joints, compared in millimetres. */
import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { readLeaderFile } from '../../../../web/motion/import/read';
import { madeBody, madeBvh } from '../../support/made-bvh';
import { CONVENTIONS } from '../../support/motion-files/conventions';
import { writeFbxAscii, writeFbxBinary } from '../../support/motion-files/fbx';
import { writeGlb, writeGltf } from '../../support/motion-files/glb';
import {
  bvhMotion,
  madeMotion,
  type MadeMotion,
  pairsOf,
  worstMillimetres,
} from '../../support/motion-files/made-motion';

/** Largest error that is accepted, millimetres: the formats have single precision. */
const WORST = 0.05;

const utf8 = (text: string): Uint8Array => new TextEncoder().encode(text);

/** Formats that name their joints freely, with what writes them. */
const FORMATS: readonly (readonly [string, (motion: MadeMotion) => Uint8Array])[] = [
  ['fbx', (motion) => writeFbxBinary(motion, {})],
  ['fbx', (motion) => writeFbxAscii(motion, { up: 'z' })],
  ['glb', (motion) => writeGlb(motion, {})],
  ['gltf', (motion) => writeGltf(motion, null).gltf],
];

describe.each(CONVENTIONS)('$label', ({ reported, names }) => {
  test.each([
    ['y', 100],
    ['z', 1],
  ] as const)('BVH, %s up, %i units a metre', async (up, unitsPerMetre) => {
    const made = madeBvh({ joints: madeBody(names), up, unitsPerMetre });
    const file = await readLeaderFile([{ name: 'a.bvh', bytes: utf8(made.text) }]);
    expect(file.report).toMatchObject({ convention: reported, upAxis: up });
    expect(worstMillimetres(file, bvhMotion(made, names, 40))).toBeLessThan(WORST);
  });

  test.each(FORMATS)('%s %#', async (ending, write) => {
    const motion = madeMotion({ names });
    const file = await readLeaderFile([{ name: `a.${ending}`, bytes: write(motion) }]);
    expect(file.report.convention).toBe(reported);
    for (const [joint, name] of pairsOf(names)) expect(file.report.joints[joint]).toBe(name);
    expect(worstMillimetres(file, motion)).toBeLessThan(WORST);
    const doubts = reported === 'found by shape' ? 1 : 0;
    expect(file.report.warnings).toHaveLength(doubts);
    expect(file.report.mappedBy).toBe(doubts ? 'structure' : 'names');
  });
});

test('the table of the documents has exactly these conventions', () => {
  const text = readFileSync('docs/motion-files.md', 'utf8');
  const [, table = ''] = /\n\| convention \|.*\n.*\n((?:\|.*\n)+)/.exec(text) ?? [];
  const rows = table
    .trim()
    .split('\n')
    .map((row) => row.split('|')[1]!.trim());
  expect(rows).toEqual(CONVENTIONS.map(({ label }) => label));
});
